// CGAL's hole filling on one closed polygon: `cgal SEARCH ROUNDS`, SEARCH being `full` (all
// triples) or `delaunay` (edges of the Delaunay tetrahedra), the points on standard input. Prints
// the least processor time of that many rounds in seconds, and how many triangles there are.
// `cgal version` prints the version.
//
// This program links CGAL, which is under the GPL; nothing of ours does.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/version.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Triangle = std::tuple<int, int, int>;

int main(int count, char** arguments) {
  const std::string search = count > 1 ? arguments[1] : "";
  if (search == "version") {
    std::cout << CGAL_VERSION_STR << '\n';
    return 0;
  }
  if (count != 3 || (search != "full" && search != "delaunay")) {
    std::cerr << "usage: cgal full|delaunay ROUNDS < points\n";
    return 2;
  }
  std::vector<Point> points;
  for (double x, y, z; std::cin >> x >> y >> z;) points.emplace_back(x, y, z);

  double least = std::numeric_limits<double>::infinity();
  std::vector<Triangle> triangles;
  for (int round = std::atoi(arguments[2]); round > 0; --round) {
    triangles.clear();
    const std::clock_t start = std::clock();
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(
        points, std::back_inserter(triangles),
        CGAL::parameters::use_delaunay_triangulation(search == "delaunay")
            .use_2d_constrained_delaunay_triangulation(false));
    least = std::min(least, double(std::clock() - start) / CLOCKS_PER_SEC);
  }
  std::cout << least << ' ' << triangles.size() << '\n';
}
