// The plain loop that pictures are measured against: one triangle after the other, one thread.
// The same rules as nmatrix: corners on 1/256 sample, top-left, nearest depth, light per sample.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace {

constexpr int64_t STEP = 256;

struct Edge {
  int64_t value, right, down;  // at the first sample; what one column and one row add
};

// Not negative inside and on left and top edges, for corners in clockwise order on the screen.
Edge edge(int64_t x0, int64_t y0, int64_t x1, int64_t y1, int64_t x, int64_t y) {
  const int64_t dx = x1 - x0, dy = y1 - y0;
  const int64_t outside = dy < 0 || (dy == 0 && dx > 0) ? 0 : 1;
  return {dx * (y - y0) - dy * (x - x0) - outside, -dy * STEP, dx * STEP};
}

struct Box {
  int left, right, top, bottom;
};

Box box(const int64_t x[3], const int64_t y[3], int width, int height) {
  const auto [left, right] = std::minmax({x[0], x[1], x[2]});
  const auto [top, bottom] = std::minmax({y[0], y[1], y[2]});
  return {int(std::max<int64_t>(0, (left + STEP - 1) >> 8)),
          int(std::min<int64_t>(width - 1, right >> 8)),
          int(std::max<int64_t>(0, (top + STEP - 1) >> 8)),
          int(std::min<int64_t>(height - 1, bottom >> 8))};
}

// A number that is linear on the screen: at the first sample of a box, and what it grows by.
struct Plane {
  float start, right, down;
};

Plane plane(const float* values, const int64_t corner[3], const int64_t x[3], const int64_t y[3],
            float over_area, int left, int top) {
  const float a = values[corner[0]], u = values[corner[1]] - a, v = values[corner[2]] - a;
  const float ax = x[1] - x[0], ay = y[1] - y[0], bx = x[2] - x[0], by = y[2] - y[0];
  const float right = (u * by - v * ay) * over_area, down = (v * ax - u * bx) * over_area;
  return {a + right * (left - x[0] / 256.f) + down * (top - y[0] / 256.f), right, down};
}

struct Vertices {
  std::vector<int64_t> x, y;
  std::vector<float> depth, normal[3];  // normals times 1/w
};

Vertices transformed(const double* position, const double* normal, int64_t count,
                     const double* m, int width, int height) {
  Vertices out;
  out.x.resize(count), out.y.resize(count), out.depth.resize(count);
  for (auto& one : out.normal) one.resize(count);
  for (int64_t i = 0; i < count; i++) {
    const double x = position[3 * i], y = position[3 * i + 1], z = position[3 * i + 2];
    double clip[4];
    for (int r = 0; r < 4; r++)
      clip[r] = m[4 * r] * x + m[4 * r + 1] * y + m[4 * r + 2] * z + m[4 * r + 3];
    const double inverse_w = 1 / clip[3];
    out.x[i] = int64_t(std::nearbyint((clip[0] * inverse_w + 1) * width * 128 - 128));
    out.y[i] = int64_t(std::nearbyint((1 - clip[1] * inverse_w) * height * 128 - 128));
    out.depth[i] = float(clip[2] * inverse_w * .5 + .5);
    for (int k = 0; k < 3; k++) out.normal[k][i] = float(normal[3 * i + k] * inverse_w);
  }
  return out;
}

}  // namespace

// Lambert's cosine for a light at infinity; `front` is the sign of the area of front faces.
extern "C" void draw(const double* position, const double* normal, int64_t vertices,
                     const int64_t* triangle, int64_t triangles, const double* matrix,
                     const float* light, int front, int width, int height, float* nearest,
                     uint8_t* image) {
  const Vertices v = transformed(position, normal, vertices, matrix, width, height);
  std::fill_n(nearest, int64_t(width) * height, 2.f);
  std::fill_n(image, int64_t(width) * height, uint8_t(30));
  for (int64_t t = 0; t < triangles; t++) {
    int64_t c[3] = {triangle[3 * t], triangle[3 * t + 1], triangle[3 * t + 2]};
    if (front < 0) std::swap(c[1], c[2]);
    const int64_t x[3] = {v.x[c[0]], v.x[c[1]], v.x[c[2]]};
    const int64_t y[3] = {v.y[c[0]], v.y[c[1]], v.y[c[2]]};
    const int64_t area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
    if (area <= 0) continue;
    const Box b = box(x, y, width, height);
    if (b.left > b.right || b.top > b.bottom) continue;
    Edge e[3];
    for (int i = 0; i < 3; i++) {
      const int j = (i + 1) % 3;
      e[i] = edge(x[i], y[i], x[j], y[j], b.left * STEP, b.top * STEP);
    }
    const float over_area = 256.f / area;
    const Plane z = plane(v.depth.data(), c, x, y, over_area, b.left, b.top);
    Plane n[3];
    for (int k = 0; k < 3; k++)
      n[k] = plane(v.normal[k].data(), c, x, y, over_area, b.left, b.top);
    for (int row = b.top; row <= b.bottom; row++) {
      const float down = row - b.top;
      const int64_t first = int64_t(row) * width;
      int64_t e0 = e[0].value, e1 = e[1].value, e2 = e[2].value;
      const float z0 = z.start + z.down * down;
      const float p0 = n[0].start + n[0].down * down, q0 = n[1].start + n[1].down * down;
      const float r0 = n[2].start + n[2].down * down;
      for (int column = b.left; column <= b.right; column++) {
        if ((e0 | e1 | e2) >= 0) {
          const float right = column - b.left, depth = z0 + z.right * right;
          if (depth < nearest[first + column]) {
            nearest[first + column] = depth;
            const float p = p0 + n[0].right * right, q = q0 + n[1].right * right;
            const float r = r0 + n[2].right * right;
            const float cosine =
                (p * light[0] + q * light[1] + r * light[2]) / std::sqrt(p * p + q * q + r * r);
            const float level = .2f * 255 + .8f * 255 * std::max(cosine, 0.f);
            image[first + column] = uint8_t(std::min(level, 255.f) + .5f);
          }
        }
        e0 += e[0].right, e1 += e[1].right, e2 += e[2].right;
      }
      for (auto& one : e) one.value += one.down;
    }
  }
}

// How many triangles with the sign of area `front` take each sample, by whole numbers alone.
extern "C" void count(const double* vx, const double* vy, const int64_t* triangle,
                      int64_t triangles, int front, int width, int height, int32_t* hits) {
  for (int64_t t = 0; t < triangles; t++) {
    int64_t x[3], y[3];
    for (int i = 0; i < 3; i++) {
      const int64_t corner = triangle[3 * t + (front < 0 ? (3 - i) % 3 : i)];
      x[i] = int64_t(vx[corner]), y[i] = int64_t(vy[corner]);
    }
    if ((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]) <= 0) continue;
    const Box b = box(x, y, width, height);
    for (int row = b.top; row <= b.bottom; row++)
      for (int column = b.left; column <= b.right; column++) {
        bool inside = true;
        for (int i = 0; i < 3; i++) {
          const int j = (i + 1) % 3;
          inside &= edge(x[i], y[i], x[j], y[j], column * STEP, row * STEP).value >= 0;
        }
        hits[int64_t(row) * width + column] += inside;
      }
  }
}
