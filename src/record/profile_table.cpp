// profile-STAGE.csv: the surface at the start and the end of a stage.

#include "clca/measure/profile.hpp"
#include "record/internal/observer.hpp"

namespace clca::record {

namespace {

struct ProfileRow {
  double x;
  double start;
  double end;
};

TableOf<ProfileRow> profile_table(const scene::Scene& /*scene*/) {
  return {{.name = "profile", .kind = TableInfo::Kind::parts},
          {{{"x", "Position", "spacings", "of a column of the lattice"}, &ProfileRow::x},
           {{"height_start", "Height at the start", "spacings",
             "of the surface, after walls have gone and the fill is placed"},
            &ProfileRow::start},
           {{"height_end", "Height at the end", "spacings", "of the surface"}, &ProfileRow::end}}};
}

class Profile : public Observer {
 public:
  explicit Profile(const scene::Scene& scene) : table_(scene, profile_table(scene)) {}

  void end_stage(const StageView& now) override {
    const std::vector<double> end = measure::surface_profile(now.model.state());
    for (std::size_t column = 0; column < end.size(); ++column) {
      table_.add({lattice::kColumnPitch * static_cast<double>(column),
                  now.history.profile_at_start[column], end[column]});
    }
    table_.write(now.output_folder, now.stage.name);
  }
  std::vector<RunTable*> tables() override { return {&table_}; }

 private:
  TableWriter<ProfileRow> table_;
};

}  // namespace

ObserverFactory profile_observer() {
  return observer_factory<Profile>(
      [](const scene::Scene& scene) { return requests_measure(scene, scene::Measure::profile); },
      {profile_table});
}

}  // namespace clca::record
