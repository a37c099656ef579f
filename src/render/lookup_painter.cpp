#include "render/lookup_painter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "clca/render/painter.hpp"
#include "render/colors.hpp"

namespace clca::render {

namespace {

constexpr const char* kLookupVertexSource = R"(
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(corner, 0.0, 1.0);
}
)";

// Beyond the border, owners go on for ever: floor and side walls have any thickness. All walls
// that stand are one owner, without seams between them, and all that move are another.
constexpr const char* kLookupFragmentSource = R"(
uniform isampler2D sites;     // (row, column)
uniform sampler2D colors;     // of particle i: (i % 4096, i / 4096)
uniform ivec2 last_site;      // row, column of the last texel
uniform ivec2 anchor;         // row, column of its texel
uniform vec2 corner;          // of the canvas, axial coordinates from the anchor
uniform vec2 across;          // axial step of one sample to the right
uniform float upward;         // q step of one sample up
uniform int highest_owner;    // owners above count as free
uniform vec4 paper;
uniform vec4 wall;
uniform vec4 moving_wall;
uniform int moving_wall_code;
uniform float outline_width;  // in weight
uniform float outline_strength;
out vec4 result;

const int kFree = -1;
const int kWall = -2;
const int kMovingWall = -3;

int owner(int row, int column) {
  int code = texelFetch(sites, clamp(anchor + ivec2(row, column), ivec2(0), last_site), 0).r;
  int wall_kind = code == moving_wall_code ? kMovingWall : kWall;
  return code > highest_owner ? kFree : code < kFree ? wall_kind : code;
}

void main() {
  vec2 place = corner + gl_FragCoord.x * across + vec2(0.0, gl_FragCoord.y * upward);
  vec2 low = floor(place);
  vec2 part = place - low;
  ivec2 cell = ivec2(low);  // axial
  int left_row = cell.y + (cell.x >> 1);
  int right_row = cell.y + ((cell.x + 1) >> 1);
  float sum = part.x + part.y;
  bool upper = sum >= 1.0;
  // The corners: lower left or upper right one, right one, the one above; and their weights.
  int a = owner(upper ? right_row + 1 : left_row, upper ? cell.x + 1 : cell.x);
  int b = owner(right_row, cell.x + 1);
  int c = owner(left_row + 1, cell.x);
  vec3 weight = upper ? vec3(sum - 1.0, 1.0 - part.y, 1.0 - part.x) : vec3(1.0 - sum, part);
  // Of owners with several corners, the first one speaks for all.
  float of_a = weight.x + (b == a ? weight.y : 0.0) + (c == a ? weight.z : 0.0);
  float of_b = weight.y + (c == b ? weight.z : 0.0);
  int best = of_a >= 0.5 ? a : of_b >= 0.5 ? b : weight.z >= 0.5 ? c : kFree;
  float most = max(of_a, max(of_b, weight.z));
  vec4 fill = texelFetch(colors, ivec2(best & 4095, best >> 12), 0);
  vec4 particle = most - 0.5 < outline_width
      ? vec4(outline_color(fill.rgb, outline_strength), 1.0) : fill;
  vec4 wall_color = best == kMovingWall ? moving_wall : wall;
  result = best == kFree ? paper : best < kFree ? wall_color : particle;
}
)";

constexpr GLint kSitesUnit = 0;
constexpr GLint kColorsUnit = 1;
constexpr std::size_t kColorsInRow = 4096;  // as in the shader

lattice::Rectangle common(const lattice::Rectangle& a, const lattice::Rectangle& b) {
  return {std::max(a.left, b.left), std::max(a.bottom, b.bottom), std::min(a.right, b.right),
          std::min(a.top, b.top)};
}

}  // namespace

LookupPainter::LookupPainter(const Gl& gl, const lattice::Lattice& lattice, int largest_window)
    : gl_(&gl),
      lattice_(lattice),
      largest_window_(largest_window > 0 ? largest_window : gl.integer(GL_MAX_TEXTURE_SIZE)),
      program_(gl.program({kLookupVertexSource}, {kOutlineColorSource, kLookupFragmentSource})),
      vertex_array_(gl.vertex_array()),
      sites_(gl, lattice),
      colors_(gl.texture()) {
  gl.UseProgram(program_);
  gl.Uniform1i(place("sites"), kSitesUnit);
  gl.Uniform1i(place("colors"), kColorsUnit);
  const auto set_color = [&](const char* name, Rgb color) {
    const auto share = [](std::uint8_t channel) { return static_cast<float>(channel) / 255.0F; };
    gl.Uniform4f(place(name), share(color.red), share(color.green), share(color.blue), 1.0F);
  };
  set_color("paper", kPaper);
  set_color("wall", kWallColor);
  set_color("moving_wall", kMovingWallColor);
  gl.Uniform1i(place("moving_wall_code"), kMovingWall);
}

void LookupPainter::upload_colors(std::span<const Rgb> colors) {
  const std::size_t rows = colors.size() / kColorsInRow + 1;
  if (rows > static_cast<std::size_t>(gl_->integer(GL_MAX_TEXTURE_SIZE))) {
    throw RenderError(fmt::format("{} particles are too many to draw", colors.size()));
  }
  rgba_.resize(4 * kColorsInRow * rows);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    rgba_[4 * i] = colors[i].red;
    rgba_[4 * i + 1] = colors[i].green;
    rgba_[4 * i + 2] = colors[i].blue;
    rgba_[4 * i + 3] = 255;
  }
  gl_->BindTexture(GL_TEXTURE_2D, colors_);
  const auto height = static_cast<GLsizei>(rows);
  if (height > color_rows_) {
    color_rows_ = height;
    gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, kColorsInRow, height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                    nullptr);
    gl_->check("a texture of colours");
  }
  gl_->TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, kColorsInRow, height, GL_RGBA, GL_UNSIGNED_BYTE,
                     rgba_.data());
}

void LookupPainter::set_view(const Projection& projection, bool particles) {
  const double step = 1 / projection.scale;
  const Eigen::Vector2d corner = projection.corner_from_anchor();
  const double column = corner.x() / lattice::kColumnPitch;
  const double across = step / lattice::kColumnPitch;
  gl_->UseProgram(program_);
  gl_->Uniform2f(place("corner"), static_cast<float>(column),
                 static_cast<float>(corner.y() - 0.5 * column));
  gl_->Uniform2f(place("across"), static_cast<float>(across), static_cast<float>(-0.5 * across));
  gl_->Uniform1f(place("upward"), static_cast<float>(step));
  gl_->Uniform1i(place("highest_owner"),
                 particles ? std::numeric_limits<GLint>::max() : automaton::kFree);
  // Weight grows by one over the altitude of a lattice triangle, which is the column pitch.
  const double width = projection.outline_strength > 0 ? projection.outline_width : -1;
  gl_->Uniform1f(place("outline_width"), static_cast<float>(width / lattice::kColumnPitch));
  gl_->Uniform1f(place("outline_strength"), static_cast<float>(projection.outline_strength));
}

void LookupPainter::draw(const Projection& projection, const Tile& tile) {
  const SampleBox box = projection.samples_in(tile.area);
  const SiteWindow& window = tile.sites;
  gl_->Scissor(box.x, box.y, box.width, box.height);
  gl_->Uniform2i(place("anchor"), projection.anchor.row - window.first_row,
                 projection.anchor.column - window.first_column);
  gl_->Uniform2i(place("last_site"), window.rows() - 1, window.columns() - 1);
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

void LookupPainter::draw(const Projection& projection, const lattice::Rectangle& clip,
                         const automaton::Occupancy& occupancy, std::span<const Rgb> colors,
                         std::span<const lattice::Site> moving_walls) {
  gl_->ActiveTexture(GL_TEXTURE0 + kColorsUnit);
  upload_colors(colors);
  gl_->ActiveTexture(GL_TEXTURE0 + kSitesUnit);
  set_view(projection, !colors.empty());
  gl_->BindVertexArray(vertex_array_);
  gl_->Enable(GL_SCISSOR_TEST);
  for (const Tile& tile : tiles(lattice_, common(clip, projection.view()), largest_window_)) {
    sites_.upload(occupancy, tile.sites);
    sites_.mark(moving_walls, tile.sites);
    draw(projection, tile);
  }
  gl_->check("drawing by lookup");
}

}  // namespace clca::render
