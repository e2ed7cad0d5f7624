// CGAL's exact test on a file of pairs: prints how many intersect and the nanoseconds per pair, the best of five rounds.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangle_3.h>
#include <CGAL/intersections.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangle = Kernel::Triangle_3;
using Clock = std::chrono::steady_clock;

int main(int argc, char **argv) {
  if (argc != 2) {
    std::fprintf(stderr, "expected one file of pairs, .f64\n");
    return 2;
  }
  std::ifstream file(argv[1], std::ios::binary);
  std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  const double *x = reinterpret_cast<const double *>(bytes.data());
  std::vector<Triangle> triangles;
  for (size_t i = 0; i + 9 <= bytes.size() / sizeof(double); i += 9) {
    const double *t = x + i;
    triangles.emplace_back(Kernel::Point_3(t[0], t[1], t[2]), Kernel::Point_3(t[3], t[4], t[5]), Kernel::Point_3(t[6], t[7], t[8]));
  }
  size_t intersecting = 0;
  double best = 1e300;
  for (int round = 0; round < 5; round++) {
    intersecting = 0;
    auto start = Clock::now();
    for (size_t i = 0; i + 1 < triangles.size(); i += 2)
      intersecting += CGAL::do_intersect(triangles[i], triangles[i + 1]);
    best = std::min(best, std::chrono::duration<double, std::nano>(Clock::now() - start).count());
  }
  std::printf("%zu %.0f\n", intersecting, best / (triangles.size() / 2));
}
