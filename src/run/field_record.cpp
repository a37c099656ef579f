#include "run/field_record.hpp"

#include <limits>

namespace clca::run {

namespace {

std::vector<std::string> field_columns(bool has_time) {
  std::vector<std::string> names = {"stage",     "step", "x",  "y",          "packing",
                                    "particles", "vx",   "vy", "fluctuation"};
  if (has_time) {
    names.insert(names.begin() + 2, "time");
  }
  return names;
}

}  // namespace

FieldRecord::FieldRecord(const scene::Fields& fields,
                         const std::optional<scene::Conversion>& conversion)
    : fields_(fields),
      conversion_(conversion),
      speed_(conversion ? conversion->velocity(1) : 1),
      table_(field_columns(conversion.has_value())) {}

void FieldRecord::begin_stage(const std::string& stage, const grains::State& state) {
  stage_ = stage;
  window_.emplace(state);
  window_begin_ = state.step;
  fluctuations_ = {};
  fluctuation_steps_ = 0;
  steps_ = 0;
}

bool FieldRecord::precedes(const grains::State& now) const {
  return window_ && window_->precedes(now) && window_begin_ <= now.step &&
         fluctuations_.has_all_bins();
}

void FieldRecord::after_step(const grains::State& state) {
  if (state.step - window_begin_ >= fields_.every) {
    end_window(state);
  }
}

void FieldRecord::end_stage(const grains::State& state) {
  if (state.step > window_begin_) {
    end_window(state);
  }
}

void FieldRecord::end_window(const grains::State& state) {
  const measure::Fields fields = window_->fields(state, fields_.cell);
  for (const measure::FieldCell& cell : fields.cells) {
    if (cell.particles > 0 || cell.packing > 0) {
      std::vector<store::Cell> cells = {stage_, state.step};
      if (conversion_) {
        cells.emplace_back(conversion_->time(state.step));
      }
      cells.insert(cells.end(), {cell.centre.x(), cell.centre.y(), cell.packing,
                                 std::uint64_t{cell.particles}, cell.velocity.x() * speed_,
                                 cell.velocity.y() * speed_, cell.fluctuation * speed_ * speed_});
      table_.add_row(std::move(cells));
    }
  }
  const std::uint64_t steps = state.step - window_begin_;
  if (steps == fields_.every) {
    fluctuations_.add(window_->displacements(state), measure::Grid(state.lattice, fields_.cell));
  }
  fluctuation_steps_ += measure::fluctuation_energy(fields) * static_cast<double>(steps);
  steps_ += steps;
  window_.emplace(state);
  window_begin_ = state.step;
}

double FieldRecord::fluctuation_energy() const {
  const double energy = steps_ > 0 ? fluctuation_steps_ / static_cast<double>(steps_) : 0;
  return energy * speed_ * speed_;
}

std::string FieldRecord::fluctuation_csv() const {
  store::Table table({"lower", "upper", "share", "share_local", "reference"});
  const statistics::Bins& bins = fluctuations_.bins();
  const std::vector<double> shares = fluctuations_.shares();
  const std::vector<double> local = fluctuations_.local_shares();
  const std::vector<double> reference = statistics::chi_square_shares(bins, 2);
  for (std::size_t bin = 0; bin < bins.count(); ++bin) {
    const bool is_last = bin + 1 == bins.count();
    table.add_row({bins.lower(bin),
                   is_last ? std::numeric_limits<double>::quiet_NaN() : bins.upper(bin),
                   shares[bin], local[bin], reference[bin]});
  }
  return table.to_csv();
}

}  // namespace clca::run
