#include "run/field_record.hpp"

namespace clca::run {

FieldRecord::FieldRecord(const scene::Fields& fields)
    : fields_(fields),
      table_({"stage", "step", "x", "y", "packing", "particles", "vx", "vy", "fluctuation"}) {}

void FieldRecord::begin_stage(const std::string& stage, const automaton::State& state) {
  stage_ = stage;
  window_.emplace(state);
  window_begin_ = state.step;
  fluctuation_steps_ = 0;
  steps_ = 0;
}

void FieldRecord::after_step(const automaton::State& state) {
  if (state.step - window_begin_ >= fields_.every) {
    end_window(state);
  }
}

void FieldRecord::end_stage(const automaton::State& state) {
  if (state.step > window_begin_) {
    end_window(state);
  }
}

void FieldRecord::end_window(const automaton::State& state) {
  const measure::Fields fields = window_->fields(state, fields_.cell);
  for (const measure::FieldCell& cell : fields.cells) {
    if (cell.particles > 0 || cell.packing > 0) {
      table_.add_row({stage_, state.step, cell.centre.x(), cell.centre.y(), cell.packing,
                      std::uint64_t{cell.particles}, cell.velocity.x(), cell.velocity.y(),
                      cell.fluctuation});
    }
  }
  const std::uint64_t steps = state.step - window_begin_;
  fluctuation_steps_ += measure::fluctuation_energy(fields) * static_cast<double>(steps);
  steps_ += steps;
  window_.emplace(state);
  window_begin_ = state.step;
}

double FieldRecord::fluctuation_energy() const {
  return steps_ > 0 ? fluctuation_steps_ / static_cast<double>(steps_) : 0;
}

}  // namespace clca::run
