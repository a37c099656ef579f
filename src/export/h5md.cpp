#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "clca/store/file.hpp"
#include "export/formats.hpp"
#include "export/h5md_file.hpp"

namespace clca::exports {

using store::hdf5::check;
using store::hdf5::describe;

namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
constexpr hsize_t kPlane = 3;  // numbers of a vector; readers want three

using Numbers = std::array<float, 2>;

Numbers numbers(const Eigen::Vector2d& vector) {
  return {static_cast<float>(vector.x()), static_cast<float>(vector.y())};
}

Numbers number(double value) {
  return {static_cast<float>(value), 0};
}

std::string path(const std::string& name) {
  return "/particles/grains/" + name;
}

/// Whole numbers with the names of the species.
Handle species_type(const std::vector<scene::Species>& species) {
  Handle type(H5Tenum_create(H5T_NATIVE_INT32), H5Tclose, "species");
  std::int32_t value = 0;
  for (const scene::Species& entry : species) {
    check(H5Tenum_insert(type.id(), entry.name.c_str(), &value), "species");
    ++value;
  }
  return type;
}

/// What there is of each particle in each frame.
struct Element {
  const char* name;
  std::string unit;
  const char* meaning;
  hsize_t columns;
  Numbers (*of)(const Body& body);
};

std::vector<Element> elements_of(const scene::Scene& scene) {
  const bool is_contact = scene.model == scene::Model::contact;
  const auto units = scene::conversion(scene);
  std::vector<Element> elements = {
      {"position", "spacings", "x, y of the centre of mass, in the box; z is 0", kPlane,
       [](const Body& body) { return numbers(body.centre); }},
      {"velocity", units ? units->velocity_unit : "spacings/step",
       "x, y, 0; of the automaton the last move", kPlane,
       [](const Body& body) { return numbers(body.velocity); }},
      {"displacement", "spacings",
       "x, y, 0: since the stage began or the particle entered, across a periodic boundary, too",
       kPlane, [](const Body& body) { return numbers(body.displacement); }},
      {"load", is_contact ? "weights of a grain of mean mass" : "sites",
       is_contact ? "sum of the normal forces on the particle"
                  : "that the particle shares with others and with walls",
       1, [](const Body& body) { return number(body.force); }}};
  if (is_contact) {
    elements.push_back({"angular_velocity", fmt::format("radians/({})", units->time_unit),
                        "anticlockwise", 1,
                        [](const Body& body) { return number(body.angular_velocity); }});
  }
  if (scene.box.periodic) {
    elements.push_back({"image", "", "widths of the box that it has moved to the right; 0, 0",
                        kPlane, [](const Body& body) { return number(body.image); }});
  }
  return elements;
}

}  // namespace

class H5mdWriter::Content {
 public:
  Content(const std::string& file, const scene::Scene& scene, std::vector<grains::Kind> kinds)
      : file_(new_file(file)),
        scene_(scene),
        kinds_(std::move(kinds)),
        elements_(elements_of(scene)) {
    const std::array<std::int32_t, 2> version = {1, 1};
    add_attribute(new_group(file_, "/h5md"), "version", H5T_NATIVE_INT32, {version.size()},
                  version.data());
    add_texts(new_group(file_, "/h5md/author"), "name", {"unknown"});
    const Handle creator = new_group(file_, "/h5md/creator");
    add_texts(creator, "name", {"clca"});
    add_texts(creator, "version", {CLCA_VERSION});
    new_group(file_, "/particles");
    new_group(file_, "/particles/grains");
  }

  void add(const grains::State& state, const std::vector<Body>& all) {
    if (values_.empty()) {
      begin(state);
    }
    const auto step = static_cast<std::int64_t>(state.step);
    const double time = static_cast<double>(state.step) * time_step(scene_);
    const Eigen::Vector2d box = state.lattice.size();
    const std::array<double, kPlane> edges = {box.x(), box.y(), 1};
    step_->append({}, &step);
    time_->append({}, &time);
    edges_->append({kPlane}, edges.data());
    rows_ = state.particles.size();
    species_.resize(rows_);
    mass_.resize(rows_, kNone);
    std::vector<std::int32_t> ids(rows_, kNoId);
    for (const Body& body : all) {
      ids[body.id] = static_cast<std::int32_t>(body.id);
      species_[body.id] = kinds_[body.kind].species;
      mass_[body.id] = static_cast<float>(kinds_[body.kind].shape.size());
    }
    id_->append({rows_}, ids.data());
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      append(elements_[i], all, values_[i]);
    }
  }

  void finish() {
    add_list("species", species_type(scene_.species).id(), species_.data(), "",
             "its name is that of the number in the type");
    add_list("mass", H5T_NATIVE_FLOAT, mass_.data(), "sites", "of the particle");
    check(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL), "flush");
  }

 private:
  static constexpr std::int32_t kNoId = -1;

  /// Makes the datasets, with chunks for so many particles.
  void begin(const grains::State& state) {
    constexpr hsize_t kFew = 64;
    constexpr hsize_t kMany = 16384;
    const hsize_t chunk = std::clamp<hsize_t>(state.particles.size(), kFew, kMany);
    const auto units = scene::conversion(scene_);
    new_group(file_, path("position"));
    step_.emplace(file_, path("position/step"), H5T_NATIVE_INT64, Dimensions{kFew}, nullptr);
    describe(step_->dataset(), "steps", "of the whole run");
    time_.emplace(file_, path("position/time"), H5T_NATIVE_DOUBLE, Dimensions{kFew}, nullptr);
    describe(time_->dataset(), units ? units->time_unit : "steps", "of the whole run");
    begin_box(state.lattice.periodic());
    for (const Element& element : elements_) {
      if (&element != &elements_.front()) {
        begin_group(element.name);
      }
      Dimensions size = {1, chunk};
      if (element.columns > 1) {
        size.push_back(element.columns);
      }
      values_.emplace_back(file_, path(fmt::format("{}/value", element.name)), H5T_NATIVE_FLOAT,
                           size, &kNone);
      describe(values_.back().dataset(), element.unit, element.meaning);
    }
    begin_group("id");
    id_.emplace(file_, path("id/value"), H5T_NATIVE_INT32, Dimensions{1, chunk}, &kNoId);
    describe(id_->dataset(), "",
             "of the particle: the number of the row, or -1 if it is not there");
  }

  void begin_box(bool periodic) {
    const Handle box = new_group(file_, path("box"));
    const auto dimension = static_cast<std::int32_t>(kPlane);
    add_attribute(box, "dimension", H5T_NATIVE_INT32, {}, &dimension);
    add_texts(box, "boundary", {periodic ? "periodic" : "none", "none", "none"});
    begin_group("box/edges");
    edges_.emplace(file_, path("box/edges/value"), H5T_NATIVE_DOUBLE, Dimensions{1, kPlane},
                   nullptr);
    describe(edges_->dataset(), "spacings", "width and height of the box; 1 for the third edge");
  }

  /// An element with the steps and times of the positions.
  void begin_group(const std::string& name) {
    const Handle group = new_group(file_, path(name));
    for (const char* shared : {"step", "time"}) {
      check(H5Lcreate_hard(file_.id(), path(fmt::format("position/{}", shared)).c_str(), group.id(),
                           shared, H5P_DEFAULT, H5P_DEFAULT),
            "link");
    }
  }

  void append(const Element& element, const std::vector<Body>& all, GrowingDataset& values) const {
    const hsize_t columns = element.columns;
    std::vector<float> row(rows_ * columns, kNone);
    for (const Body& body : all) {
      const Numbers in_plane = element.of(body);
      for (hsize_t column = 0; column < columns; ++column) {
        row[body.id * columns + column] = column < in_plane.size() ? in_plane.at(column) : 0;
      }
    }
    values.append(columns > 1 ? Dimensions{rows_, columns} : Dimensions{rows_}, row.data());
  }

  /// A number for each particle that does not change.
  void add_list(const char* name, hid_t type, const void* list, const char* unit,
                const char* meaning) const {
    const Handle space(H5Screate_simple(1, &rows_, nullptr), H5Sclose, "extent");
    const Handle create(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "properties");
    check(H5Pset_obj_track_times(create.id(), false), "times");
    const Handle dataset(H5Dcreate2(file_.id(), path(name).c_str(), type, space.id(), H5P_DEFAULT,
                                    create.id(), H5P_DEFAULT),
                         H5Dclose, "dataset");
    check(H5Dwrite(dataset.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, list), "write");
    describe(dataset, unit, meaning);
  }

  Handle file_;
  const scene::Scene& scene_;
  std::vector<grains::Kind> kinds_;
  std::vector<Element> elements_;
  std::vector<GrowingDataset> values_;  // of each element
  std::optional<GrowingDataset> step_;
  std::optional<GrowingDataset> time_;
  std::optional<GrowingDataset> edges_;
  std::optional<GrowingDataset> id_;
  hsize_t rows_ = 0;                   // particles that had entered
  std::vector<std::int32_t> species_;  // by id
  std::vector<float> mass_;            // by id, in sites
};

template <class Call>
void H5mdWriter::by_library(Call call) {
  try {
    const store::hdf5::Session session;
    call();
  } catch (const store::hdf5::Error& error) {
    throw store::StoreError(
        fmt::format("cannot write {}: the HDF5 library: {}", path_, error.what()));
  }
}

H5mdWriter::H5mdWriter(const store::OutputFile& file, const scene::Scene& scene,
                       const std::vector<grains::Kind>& kinds)
    : path_(file.path().string()), file_(file.create()), units_(scene::conversion(scene)) {
  by_library(
      [&] { content_ = std::make_unique<Content>(file_.temporary_path().string(), scene, kinds); });
}

H5mdWriter::~H5mdWriter() {
  const store::hdf5::Session session;
  content_.reset();
}

void H5mdWriter::add(const grains::State& state, const store::ContactFrame& contact) {
  const std::vector<Body> all = bodies(state, contact, units_);
  by_library([&] { content_->add(state, all); });
}

void H5mdWriter::finish() {
  by_library([&] {
    content_->finish();
    content_.reset();
  });
  file_.finish();
}

}  // namespace clca::exports
