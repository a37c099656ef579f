#pragma once
// Exports trajectory frames: VTK for ParaView, GSD and extended XYZ for OVITO, H5MD. See
// docs/trajectory.md. The namespace is `exports`, since `export` is a keyword.

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
#include "clca/text/input_error.hpp"

namespace clca::exports {

/// The requested data do not exist. what() is one line.
class ExportError : public text::InputError {
 public:
  using InputError::InputError;
};

enum class Format : std::uint8_t { vtp, gsd, xyz, h5md };

/// File ending: .pvd, .gsd, .xyz or .h5.
std::string_view ending(Format format);

/// Writes frames one by one, with one in memory at a time.
class Writer {
 public:
  Writer() = default;
  virtual ~Writer() = default;
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Steps must not decrease. Throws store::StoreError.
  virtual void add(const grains::State& state, const store::ContactFrame& contact) = 0;
  /// Completes the file; nothing can be added afterwards. Throws store::StoreError.
  virtual void finish() = 0;
};

/// A writer for `file`; VTK also writes a file per frame beside it. All states must be of this
/// scene with these kinds. Throws store::StoreError.
std::unique_ptr<Writer> writer(Format format, const store::OutputFile& file,
                               const scene::Scene& scene, const std::vector<grains::Kind>& kinds);

/// Selection of frames by step.
struct FrameSelection {
  std::optional<std::uint64_t> from = {};   ///< first step
  std::optional<std::uint64_t> until = {};  ///< last step
  /// Minimum steps between frames of a stage; the first frame of a stage is always included.
  std::uint64_t every = 1;
};

/// Indices of the selected frames. Throws ExportError if there are none.
std::vector<std::size_t> selected_frames(const std::vector<store::Trajectory::Frame>& frames,
                                         const FrameSelection& selection);

/// Writes the selected frames and returns their number. If `stop` is not 0, ends early with a
/// complete file (none without a frame). Throws ExportError and store::StoreError.
std::size_t write(const store::Trajectory& trajectory, const FrameSelection& selection,
                  Writer& writer, const std::atomic<int>& stop);

}  // namespace clca::exports
