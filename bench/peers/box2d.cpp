// The wall-removal test by Box2D, as in.lammps does it: discs that do not turn, lengths in lattice
// spacings, gravity 1. bench/peers/README.md says what the numbers are.
//   clca_box2d RAIN OUT FLOOR LEFT WALL FRICTION DIAMETER REST_ENERGY REST_CHECKS
// RAIN is a file for read_data of LAMMPS; OUT.settling and OUT.collapse are written like its dumps.

#include <box2d/box2d.h>

#include <cstddef>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

// What Box2D is made for: bodies of about a metre, gravity 10 m/s^2, 60 steps a second.
constexpr float kGravity = 10;
constexpr float kTimeStep = 1.0F / 60;
constexpr int kVelocityIterations = 8;
constexpr int kPositionIterations = 3;

struct Problem {
  std::string rain;
  std::string out;
  double floor = 0;
  double left = 0;
  double wall = 0;
  double friction = 0;
  double diameter = 0;     ///< mean, one metre of Box2D
  double rest_energy = 0;  ///< kinetic energy per disc, below which a bed rests
  int rest_checks = 0;     ///< so many in a row
};

struct Disc {
  b2Body* body = nullptr;
  double radius = 0;
};

class Test {
 public:
  explicit Test(const Problem& problem) : problem_(problem), world_({0, -kGravity}) {
    b2BodyDef fixed;
    b2Body* ground = world_.CreateBody(&fixed);
    constexpr double kFar = 1e5;
    add_face(*ground, {problem.left, problem.floor}, {kFar, problem.floor});
    add_face(*ground, {problem.left, problem.floor}, {problem.left, kFar});
    wall_ = world_.CreateBody(&fixed);
    add_face(*wall_, {problem.wall, problem.floor}, {problem.wall, kFar});
    read_rain();
  }

  void to_rest(const char* stage) {
    std::cout << "begin " << stage << std::endl;
    for (int resting = 0; resting < problem_.rest_checks;) {
      for (int i = 0; i < kStepsBetweenChecks; ++i) {
        world_.Step(kTimeStep, kVelocityIterations, kPositionIterations);
      }
      steps_ += kStepsBetweenChecks;
      const double now = energy();
      std::cout << steps_ << ' ' << now << std::endl;
      resting = now < problem_.rest_energy ? resting + 1 : 0;
    }
    std::cout << "end " << stage << ' ' << steps_ << std::endl;
    write(problem_.out + "." + stage);
  }

  void remove_wall() { world_.DestroyBody(wall_); }

 private:
  struct Point {
    double x;
    double y;
  };
  // sqrt(d/g)/2 with d = 1 m
  static constexpr int kStepsBetweenChecks = 9;

  float metres(double spacings) const { return static_cast<float>(spacings / problem_.diameter); }

  void add_face(b2Body& body, Point from, Point to) {
    b2EdgeShape edge;
    edge.SetTwoSided({metres(from.x), metres(from.y)}, {metres(to.x), metres(to.y)});
    b2FixtureDef fixture;
    fixture.shape = &edge;
    fixture.friction = static_cast<float>(problem_.friction);
    body.CreateFixture(&fixture);
  }

  void read_rain() {
    std::ifstream file(problem_.rain);
    std::string word;
    while (file >> word && word != "Atoms") {
    }
    int id = 0;
    int type = 0;
    double diameter = 0;
    double density = 0;
    Point place = {};
    double z = 0;
    while (file >> id >> type >> diameter >> density >> place.x >> place.y >> z) {
      add_disc(place, diameter / 2);
    }
    if (discs_.empty()) {
      throw std::runtime_error("there are no discs in " + problem_.rain);
    }
  }

  void add_disc(Point place, double radius) {
    b2BodyDef body;
    body.type = b2_dynamicBody;
    body.fixedRotation = true;
    body.position = {metres(place.x), metres(place.y)};
    b2CircleShape circle;
    circle.m_radius = metres(radius);
    b2FixtureDef fixture;
    fixture.shape = &circle;
    fixture.density = 1;
    fixture.friction = static_cast<float>(problem_.friction);
    b2Body* disc = world_.CreateBody(&body);
    disc->CreateFixture(&fixture);
    discs_.push_back({disc, radius});
  }

  /// Kinetic, per disc, in the units of the problem.
  double energy() const {
    double sum = 0;
    for (const Disc& disc : discs_) {
      const double mass = b2_pi * disc.radius * disc.radius;
      sum += mass / 2 * disc.body->GetLinearVelocity().LengthSquared();
    }
    const double unit = problem_.diameter / kGravity;  // of a velocity squared
    return sum * unit / static_cast<double>(discs_.size());
  }

  void write(const std::string& path) const {
    std::ofstream file(path);
    file.precision(9);
    file << "ITEM: ATOMS id x y radius\n";
    for (std::size_t i = 0; i < discs_.size(); ++i) {
      const b2Vec2 place = discs_[i].body->GetPosition();
      file << i + 1 << ' ' << place.x * problem_.diameter << ' ' << place.y * problem_.diameter
           << ' ' << discs_[i].radius << '\n';
    }
    if (!file.flush()) {
      throw std::runtime_error("cannot write " + path);
    }
  }

  Problem problem_;
  b2World world_;
  b2Body* wall_ = nullptr;
  std::vector<Disc> discs_;
  long steps_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 10) {
      throw std::runtime_error("see the head of box2d.cpp for the arguments");
    }
    const auto number = [argv](int i) { return std::stod(argv[i]); };
    Test test({.rain = argv[1],
               .out = argv[2],
               .floor = number(3),
               .left = number(4),
               .wall = number(5),
               .friction = number(6),
               .diameter = number(7),
               .rest_energy = number(8),
               .rest_checks = std::stoi(argv[9])});
    test.to_rest("settling");
    test.remove_wall();
    test.to_rest("collapse");
    return 0;
  } catch (const std::exception& error) {
    std::cout << "ERROR: " << error.what() << std::endl;
    return 1;
  }
}
