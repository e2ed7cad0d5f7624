// All contacts of two meshes by CGAL, Embree or Bullet: `peers PROGRAM DIR ROUNDS` reads a.f64 and b.f64, nine numbers a triangle, and
// poses.f64, rows and translation of B's poses; writes found.u32, pose, triangle of A and of B; and prints the least processor seconds
// for the trees and, of all queries, the mean of the least. Corners of B are moved in binary64.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>
#include <BulletCollision/Gimpact/btGImpactShape.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <embree3/rtcore.h>
#include <fstream>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using Pose = std::array<double, 12>;
using Pairs = std::vector<std::array<uint32_t, 2>>;

static double now() {
  timespec time;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return time.tv_sec + 1e-9 * time.tv_nsec;
}

static std::vector<double> read(const std::string &file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
  const double *x = reinterpret_cast<const double *>(bytes.data());
  return {x, x + bytes.size() / sizeof(double)};
}

static Triangles triangles(const std::vector<double> &x) {
  Triangles all;
  for (size_t i = 0; i + 9 <= x.size(); i += 9)
    all.emplace_back(Kernel::Point_3(x[i], x[i + 1], x[i + 2]), Kernel::Point_3(x[i + 3], x[i + 4], x[i + 5]),
                     Kernel::Point_3(x[i + 6], x[i + 7], x[i + 8]));
  return all;
}

static Triangles moved(const Triangles &all, const Pose &m) {
  auto point = [&](const Kernel::Point_3 &p) {
    auto row = [&](int i) { return m[3 * i] * p.x() + m[3 * i + 1] * p.y() + m[3 * i + 2] * p.z() + m[9 + i]; };
    return Kernel::Point_3(row(0), row(1), row(2));
  };
  Triangles found;
  found.reserve(all.size());
  for (const auto &t : all) found.emplace_back(point(t[0]), point(t[1]), point(t[2]));
  return found;
}

// A tree over A, which each triangle of B asks.
struct Cgal {
  const Triangles &a, &b;
  Tree tree;
  Cgal(const Triangles &a, const Triangles &b) : a(a), b(b), tree(a.begin(), a.end()) { tree.build(); }
  Pairs query(const Pose &pose) {
    Pairs found;
    std::vector<Tree::Primitive_id> hits;
    const Triangles at = moved(b, pose);
    for (uint32_t q = 0; q < at.size(); q++) {
      hits.clear();
      tree.all_intersected_primitives(at[q], std::back_inserter(hits));
      for (auto hit : hits) found.push_back({uint32_t(hit - a.begin()), q});
    }
    return found;
  }
};

// Trees of boxes over A and, made again in every pose, over B; what they leave is decided by CGAL.
struct Embree {
  const Triangles &a, &b;
  Triangles at;
  Pairs near;
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene first = scene(&a);
  static RTCScene scene_of(RTCDevice device, const Triangles *all) {
    RTCScene scene = rtcNewScene(device);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, all->size());
    rtcSetGeometryUserData(geometry, const_cast<Triangles *>(all));
    auto bounds = [](const RTCBoundsFunctionArguments *of) {
      const auto box = (*static_cast<const Triangles *>(of->geometryUserPtr))[of->primID].bbox();
      const float most = std::numeric_limits<float>::infinity();
      auto down = [&](double x) { return std::nextafter(float(x), -most); };
      auto up = [&](double x) { return std::nextafter(float(x), most); };
      *of->bounds_o = {down(box.xmin()), down(box.ymin()), down(box.zmin()), 0, up(box.xmax()), up(box.ymax()), up(box.zmax()), 0};
    };
    rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return scene;
  }
  RTCScene scene(const Triangles *all) { return scene_of(device, all); }
  Embree(const Triangles &a, const Triangles &b) : a(a), b(b) {}
  ~Embree() { rtcReleaseScene(first), rtcReleaseDevice(device); }
  Pairs query(const Pose &pose) {
    at = moved(b, pose);
    RTCScene second = scene(&at);
    near.clear();
    auto keep = [](void *to, RTCCollision *pairs, unsigned count) {
      for (unsigned i = 0; i < count; i++) static_cast<Pairs *>(to)->push_back({pairs[i].primID0, pairs[i].primID1});
    };
    rtcCollide(first, second, keep, &near);
    rtcReleaseScene(second);
    Pairs found;
    for (auto [p, q] : near)
      if (CGAL::do_intersect(a[p], at[q])) found.push_back({p, q});
    return found;
  }
};

// Trees of boxes and the test of two triangles of GIMPACT, as its btGImpactCollisionAlgorithm calls them, with a margin of 0.
struct Bullet {
  struct Shape {
    std::vector<double> corners;
    std::vector<int> faces;
    btTriangleIndexVertexArray mesh;
    btGImpactMeshShapePart part;
    Shape(const Triangles &all)
        : corners(flat(all)), faces(numbers(3 * all.size())),
          mesh(all.size(), faces.data(), 3 * sizeof(int), faces.size(), corners.data(), 3 * sizeof(double)), part(&mesh, 0) {
      part.setMargin(0);
      part.updateBound();
      part.lockChildShapes();
    }
    ~Shape() { part.unlockChildShapes(); }
    static std::vector<double> flat(const Triangles &all) {
      std::vector<double> x;
      for (const auto &t : all)
        for (int i = 0; i < 9; i++) x.push_back(t[i / 3][i % 3]);
      return x;
    }
    static std::vector<int> numbers(size_t count) {
      std::vector<int> all(count);
      std::iota(all.begin(), all.end(), 0);
      return all;
    }
  };
  Shape a, b;
  Bullet(const Triangles &a, const Triangles &b) : a(a), b(b) {}
  Pairs query(const Pose &m) {
    const btTransform to(btMatrix3x3(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8]), btVector3(m[9], m[10], m[11]));
    btPairSet near;
    btGImpactBoxSet::find_collision(a.part.getBoxSet(), btTransform::getIdentity(), b.part.getBoxSet(), to, near);
    Pairs found;
    btPrimitiveTriangle first, second;
    GIM_TRIANGLE_CONTACT contact;
    for (int i = 0; i < near.size(); i++) {
      a.part.getPrimitiveTriangle(near[i].m_index1, first);
      b.part.getPrimitiveTriangle(near[i].m_index2, second);
      second.applyTransform(to);
      first.buildTriPlane();
      second.buildTriPlane();
      if (first.overlap_test_conservative(second) && first.find_triangle_collision_clip_method(second, contact))
        found.push_back({uint32_t(near[i].m_index1), uint32_t(near[i].m_index2)});
    }
    return found;
  }
};

template <class Program> static void run(const std::string &dir, int rounds) {
  const Triangles a = triangles(read(dir + "/a.f64")), b = triangles(read(dir + "/b.f64"));
  const std::vector<double> numbers = read(dir + "/poses.f64");
  std::vector<Pose> poses(numbers.size() / 12);
  for (size_t i = 0; i < poses.size(); i++) std::copy_n(&numbers[12 * i], 12, poses[i].begin());
  double built = 1e300;
  std::optional<Program> program;
  for (int round = 0; round < rounds; round++) {
    program.reset();
    const double start = now();
    program.emplace(a, b);
    built = std::min(built, now() - start);
  }
  std::vector<double> best(poses.size(), 1e300);
  std::ofstream out(dir + "/found.u32", std::ios::binary);
  for (int round = 0; round < rounds; round++)
    for (uint32_t i = 0; i < poses.size(); i++) {
      const double start = now();
      const Pairs found = program->query(poses[i]);
      best[i] = std::min(best[i], now() - start);
      if (round == 0)
        for (auto [p, q] : found)
          for (uint32_t x : {i, p, q}) out.write(reinterpret_cast<const char *>(&x), sizeof x);
    }
  double sum = 0;
  for (double x : best) sum += x;
  std::printf("%.9f %.9f\n", built, sum / poses.size());
}

int main(int count, char **words) {
  const std::string program = count == 4 ? words[1] : "";
  const auto asked = program == "CGAL" ? run<Cgal> : program == "Embree" ? run<Embree> : program == "Bullet" ? run<Bullet> : nullptr;
  if (!asked) {
    std::fprintf(stderr, "expected CGAL, Embree or Bullet, a folder and a number of rounds\n");
    return 2;
  }
  asked(words[2], std::stoi(words[3]));
}
