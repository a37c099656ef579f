// What is measured and what is written.

#include <algorithm>

#include "scene/sections.hpp"
#include "scene/types.hpp"

namespace clca::scene {

namespace {

constexpr double kMaxCellSide = 1000;

bool moves_in_cycles(const Scene& scene) {
  return std::ranges::any_of(
             scene.walls,
             [](const Wall& wall) { return wall.motion && grains::is_cyclic(*wall.motion); }) ||
         std::ranges::any_of(scene.stages, vessel_has_cycles);
}

/// In the automaton there are forces only where walls enter particles.
void require_overlap(const PlacedValue& place, std::string_view what) {
  if (!walls_may_overlap(place.scene)) {
    fail(place, "no {} without a wall that moves with passive: overlap", what);
  }
}

void check_view(const lattice::Rectangle& view, const PlacedValue& place) {
  const Box& box = place.scene.box;
  if (view.right <= 0 || view.top <= 0 || view.left >= box.width || view.bottom >= box.height) {
    fail(place, "nothing of the box, {} wide and {} high, lies in {}", box.width, box.height,
         shown(view));
  }
}

/// What can be drawn depends on how walls move.
void check_frames(const PlacedValue& fields, PictureOutput& frames) {
  const Scene& scene = fields.scene;
  frames.location = location_text(fields);
  if (frames.color_by == ColorBy::force && scene.model != Model::contact) {
    require_overlap(fields.at("color_by"), "force");
  }
  const bool of_contact = frames.color_by == ColorBy::pressure || frames.color_by == ColorBy::spin;
  if (of_contact && scene.model != Model::contact) {
    fail(fields.at("color_by"), "{} goes with model: contact",
         name_of(kColorByNames, frames.color_by));
  }
  if (frames.color_by == ColorBy::axis && scene.model != Model::baxter) {
    fail(fields.at("color_by"), "axis goes with model: baxter");
  }
  constexpr std::array kWithoutBar = {ColorBy::species, ColorBy::stage_layer, ColorBy::id,
                                      ColorBy::axis};
  if (frames.color_range && std::ranges::find(kWithoutBar, frames.color_by) != kWithoutBar.end()) {
    fail(fields.at("range"), "there is no colour bar with color_by {}",
         name_of(kColorByNames, frames.color_by));
  }
  if (frames.overlay == Overlay::forces && scene.model != Model::contact) {
    require_overlap(fields.at("overlay"), "forces");
  }
  const bool of_weight = shows_weight_paths(frames.overlay);
  if (of_weight) {
    check_weight_paths(fields.at("overlay"));
  }
  if (frames.widest_line_force && !of_weight && scene.model != Model::contact) {
    fail(fields.at("force_scale"), "goes with model: contact or an overlay of weight");
  }
  if (frames.overlay == Overlay::arrows && !moves_in_cycles(scene)) {
    fail(fields.at("overlay"),
         "no arrows without a stage that moves a wall with a wave or a shake, or that turns or "
         "shakes the vessel");
  }
  if (const double side = std::max(scene.box.width, scene.box.height);
      frames.velocity_cell_side > side) {
    fail(fields.at("velocity_cell"), "expected 1 to {:g}, the longer side of the box, found {:g}",
         side, *frames.velocity_cell_side);
  }
}

Type<statistics::Range> color_bar_ends() {
  using statistics::Range;
  const auto type =
      list_of_members("`[low, high]`", number_type(-1e9, 1e9), &Range::low, &Range::high);
  return type.checked([](const statistics::Range& range, const PlacedValue& place) {
    if (range.low >= range.high) {
      fail(place, "expected [low, high] with low < high, found [{}, {}]", range.low, range.high);
    }
  });
}

Type<PictureOutput> frames_type() {
  const Type<int> pixels = integer_type(16, 65'536);
  return type_of<PictureOutput>(
      {.keys =
           {key("every", &PictureOutput::every, count_type(1, kMaxSteps),
                "steps from one picture to the next"),
            key("width", &PictureOutput::width, pixels, "pixels").defaults_to("follows the view"),
            key("height", &PictureOutput::height, pixels, "pixels").defaults_to("follows the view"),
            key("color_by", &PictureOutput::color_by, choice_type(kColorByNames),
                "what the colour of a particle means"),
            key("range", &PictureOutput::color_range, color_bar_ends(),
                "values at the ends of the colour bar, in its unit; a mark at an end says that "
                "there are values outside the range")
                .defaults_to("`[0, high]`, `high` from the scene"),
            key("layers", &PictureOutput::layer_count, integer_type(1, 256),
                "number of layers for `stage_layer`"),
            key("view", &PictureOutput::view, rectangle_type().checked(check_view),
                "the part of the plane to show")
                .defaults_to("`output.view`"),
            key("drawing", &PictureOutput::drawing, choice_type(kDrawingNames),
                "by looking up the sites around each sample (`auto` too), or as polygons by "
                "OpenGL, slower; nearly the same picture"),
            key("supersampling", &PictureOutput::supersampling, integer_type(1, 4),
                "samples per pixel along each side"),
            key("caption", &PictureOutput::has_caption, bool_type(),
                "title, stage, step or time, legend, scale bar"),
            key("style", &PictureOutput::style, choice_type(kPictureStyleNames),
                "for papers (`print`): without title, stage and step or time"),
            key("upright", &PictureOutput::turns_with_vessel, bool_type(),
                "turned as the vessel is, so that gravity points down; corners of the view may "
                "go out of the picture")
                .of(Model::contact),
            key("force_scale", &PictureOutput::widest_line_force, positive_type(1e9),
                "the force drawn as the widest line, by `weight_...` and with `model: contact`, in "
                "grain weights, or in newtons with `units.density`; there the colours of `force` "
                "end at twice it, those of `pressure` at it over the mean diameter")
                .defaults_to("from the fall height"),
            key("velocity_cell", &PictureOutput::velocity_cell_side,
                length_type(number_type(1, kMaxCellSide)),
                "side of the cells of `overlay: velocity` in lattice spacings")
                .defaults_to("from grains and view"),
            key("velocity_scale", &PictureOutput::longest_arrow_speed, positive_type(1e9),
                "the speed drawn as an arrow 0.9 cells long (without it: by each picture); the "
                "colours of `speed` end at twice it, those of `spin` where grains of mean diameter "
                "roll at half of it: spacings per step, or with `model: contact` m/s "
                "(√(spacing·gravity) without `units`)")
                .defaults_to("from the model"),
            key("overlay", &PictureOutput::overlay, choice_type(kOverlayNames),
                "what is drawn over the particles: forces between them, arrows from cycle to "
                "cycle, the mean velocity since the last picture, or weight that is passed on by a "
                "[rule](#paths-of-weight)")},
       .check = check_frames});
}

Type<SeriesOutput> series_type() {
  return type_of<SeriesOutput>(
      {.keys = {key("every", &SeriesOutput::every, count_type(1, kMaxSteps),
                    "a row at each step *of the whole run* that this divides"),
                key("forces", &SeriesOutput::has_wall_forces, bool_type(),
                    "force and torque on each wall and side of the box, means over the steps "
                    "since the last row")
                    .of(Model::contact)}});
}

Type<FieldOutput> fields_type() {
  return type_of<FieldOutput>(
      {.keys = {key("cell", &FieldOutput::cell_side, length_type(number_type(1, kMaxCellSide)),
                    "side of a cell in lattice spacings"),
                key("every", &FieldOutput::every, count_type(1, kMaxSteps), "steps of a window")}});
}

void check_contacts(const PlacedValue& fields, ContactSampling& contacts) {
  if (fields.scene.model != Model::contact) {
    require_overlap(fields, "contacts");
    return;
  }
  if (contacts.every > contacts.window_steps) {
    fail(fields.at("every"), "expected 1 to {}, the steps of {}, found {}", contacts.window_steps,
         fields.at("window").path, contacts.every);
  }
}

Type<ContactSampling> contacts_type() {
  return type_of<ContactSampling>(
      {.keys = {key("every", &ContactSampling::every, count_type(1, kMaxSteps),
                    "steps from one sample to the next; with `model: contact` at most `window`"),
                key("window", &ContactSampling::window_steps, count_type(1, kMaxSteps),
                    "steps of a mean of the forces, at the end of a stage and before each picture")
                    .of(Model::contact)},
       .check = check_contacts});
}

Type<TrajectoryOutput> trajectory_type() {
  return type_of<TrajectoryOutput>(
      {.keys = {key("every", &TrajectoryOutput::every, count_type(1, kMaxSteps),
                    "steps from one frame to the next, counted from the start of each stage"),
                key("contacts", &TrajectoryOutput::has_contacts, bool_type(),
                    "contacts and their forces, too, for `clca render` and `clca export`; about 50 "
                    "bytes a contact and frame")
                    .of(Model::contact)}});
}

Key<CheckpointIntervals> seconds_key() {
  return key("seconds", &CheckpointIntervals::every_seconds, positive_type(1e9),
             "seconds by the clock from one checkpoint to the next; nothing of the result depends "
             "on it");
}

Type<CheckpointIntervals> checkpoint_type() {
  return type_of<CheckpointIntervals>(
      {.keys = {key("every", &CheckpointIntervals::every_steps, count_type(1, kMaxSteps),
                    "steps from one checkpoint to the next"),
                seconds_key()},
       .check =
           [](const PlacedValue& fields, CheckpointIntervals& checkpoints) {
             if (!checkpoints.every_steps && !checkpoints.every_seconds) {
               fail(fields, "expected every (steps), seconds or both");
             }
           },
       .schema_members = R"("minProperties": 1)"});
}

}  // namespace

Type<CheckpointIntervals> gas_checkpoint_type() {
  return type_of<CheckpointIntervals>({.keys = {seconds_key().mark_required()}});
}

Type<Output> output_type() {
  return type_of<Output>(
      {.keys = {key("frames", &Output::frames, or_none(frames_type()),
                    "pictures: [output.frames](#outputframes)"),
                key("view", &Output::default_view, rectangle_type().checked(check_view),
                    "the part of the plane that pictures show without a `view` of their own, also "
                    "those drawn later; `--set output.frames=none` keeps that of `frames` here")
                    .defaults_to("the whole box"),
                key("series", &Output::series, or_none(series_type()),
                    "table of what changes over time: [output.series](#outputseries)")
                    .defaults_to("`none`; `{}` with `probes` or `lines`"),
                key("fields", &Output::fields, or_none(fields_type()),
                    "means over the cells of a grid: [output.fields](#outputfields)"),
                key("contacts", &Output::contacts, or_none(contacts_type()),
                    "contacts between particles, for means over time; with `model: automaton` it "
                    "needs a wall that moves with `passive: overlap`: "
                    "[output.contacts](#outputcontacts)"),
                key("trajectory", &Output::trajectory, or_none(trajectory_type()),
                    "positions of all particles and walls, frame by frame, as HDF5: "
                    "[output.trajectory](#outputtrajectory)"),
                key("checkpoint", &Output::checkpoint, or_none(checkpoint_type()),
                    "when the run saves a checkpoint, besides at its end and when it is stopped: "
                    "[output.checkpoint](#outputcheckpoint)")},
       .check = [](const PlacedValue& /*fields*/, Output& output) {
         if (output.frames && !output.frames->view) {
           output.frames->view = output.default_view;
         }
       }});
}

}  // namespace clca::scene
