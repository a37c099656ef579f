#pragma once
// The frames of a trajectory in the formats of other programs: VTK for ParaView, GSD and extended
// XYZ for OVITO. docs/export.md says what stands where. (The namespace is `exports`, since `export`
// is a word of the language.)

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "clca/grains/state.hpp"
#include "clca/scene/scene.hpp"
#include "clca/store/output_folder.hpp"
#include "clca/store/trajectory.hpp"

namespace clca::exports {

/// What was asked for is not there. what() is one line.
class ExportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class Format : std::uint8_t { vtp, gsd, xyz };

/// Ending of the file that is to be opened: .pvd, .gsd or .xyz.
std::string_view ending(Format format);

/// Takes frames, one after the other, and holds no more than one in memory.
class Writer {
 public:
  Writer() = default;
  virtual ~Writer() = default;
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Steps must not fall from frame to frame. Throws store::StoreError.
  virtual void add(const grains::State& state, const store::ContactFrame& contact) = 0;
  /// Puts the file at its place. Nothing can be added afterwards. Throws store::StoreError.
  virtual void finish() = 0;
};

/// A writer of `file`; those of VTK write files of single frames beside it. The states to come are
/// of this scene and have these kinds. Throws store::StoreError.
std::unique_ptr<Writer> writer(Format format, const store::OutputFile& file,
                               const scene::Scene& scene, const std::vector<grains::Kind>& kinds);

/// Which frames, by their steps.
struct Choice {
  std::optional<std::uint64_t> from = {};   ///< first step
  std::optional<std::uint64_t> until = {};  ///< last step
  /// Steps from frame to frame in a stage, at least; the first of a stage always counts.
  std::uint64_t every = 1;
};

/// Their places in `frames`. Throws ExportError where there is none.
std::vector<std::size_t> chosen(const std::vector<store::Trajectory::Frame>& frames,
                                const Choice& choice);

/// Writes the chosen frames of a trajectory of the scene; ends early, with a file of what was
/// written so far (none without a frame), when `stop` is not 0. Returns the number of frames.
/// Throws ExportError and store::StoreError.
std::size_t write(const store::Trajectory& trajectory, const Choice& choice, Writer& writer,
                  const std::atomic<int>& stop);

}  // namespace clca::exports
