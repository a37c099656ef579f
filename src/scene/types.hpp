#pragma once
// Kinds of values that several keys have.

#include <cstdint>
#include <vector>

#include "clca/image/image.hpp"
#include "scene/key.hpp"
#include "scene/limits.hpp"

namespace clca::scene {

/// `10^12` for round large numbers.
std::string limit_text(double number);

Yaml numbers_text(const std::vector<double>& numbers);

Type<double> number(double low, double high);
Type<double> above_zero(double high);
Type<int> integer(int low, int high);
Type<std::uint64_t> count(std::uint64_t low, std::uint64_t high);
Type<bool> yes_or_no();

/// [x, y]
Type<Eigen::Vector2d> point();
/// [left, bottom, right, top], not empty.
Type<lattice::Rectangle> rectangle();
/// The ends of a colour bar.
Type<statistics::Range> color_bar_ends();
/// A rectangle that holds at least one site of the box.
Type<lattice::Rectangle> region();

/// The path of a file or folder, as an absolute one: relative ones begin at the folder of the
/// scene.
Type<std::string> file_path_type();
/// The same for a given folder; empty if it is too long or no text of one line.
std::string file_at(const std::string& folder, const std::string& path);

/// "#rrggbb"
Type<image::Rgb> color_type();

/// A name that the scene gives to something.
Type<std::string> name_type();
/// A list of names, each at most once, as indices of the things of this `kind`: `names` of the
/// scene.
Type<std::vector<std::size_t>> references(
    const std::string& kind, std::vector<std::string_view> (*names)(const Scene& scene));

/// Numbers by species: each a whole number from 0 to `high`; 0 for those not named.
Type<std::vector<std::size_t>> counts_type(std::uint64_t high);
/// The same with at least one above 0.
Type<std::vector<std::uint32_t>> weights_type();

/// The pixels of a PNG file that the value names, as read_picture_files() has read it. Throws
/// SceneError.
const image::Image& read_picture(const Value& value, const std::string& path, const Scene& scene);
/// Texts of one length, of characters for which `allowed` holds; `about` names them in messages,
/// `pattern` in the schema.
Type<std::vector<std::string>> rows_type(bool (*allowed)(char letter), const std::string& about,
                                         const std::string& pattern);

/// `word`, or a number of the type, in messages `phrase`; `word` stands for none.
template <class T>
Type<std::optional<T>> word_or_value(const std::string& word, const Type<T>& type,
                                     const std::string& phrase) {
  return Type<std::optional<T>>(optional_type(word, ", or ", type, kOptional<T>,
                                              [=](const Value& value, const std::string& path) {
                                                return is_word(value, path, word, phrase);
                                              }));
}

/// One of the words.
template <class T, std::size_t kCount>
Type<T> choice(const std::array<Named<T>, kCount>& names) {
  const auto all = words(names);
  return own_type<T>(
      fmt::format("`{}`", fmt::join(all, "`, `")), choice_schema({all.begin(), all.end()}),
      [&names](const Value& value, const std::string& path, const Scene& /*scene*/) {
        return read_choice(value, path, names);
      },
      [&names](const T& value, const Scene& /*scene*/) {
        return Yaml::scalar(std::string(name_of(names, value)));
      });
}

}  // namespace clca::scene
