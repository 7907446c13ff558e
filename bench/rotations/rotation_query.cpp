#include "rotations/rotation_query.hpp"

#include <array>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

#include "condyle/pose.hpp"
#include "core/trigonometry.hpp"

namespace bench {
namespace {

using condyle::Vec3;

constexpr std::size_t rows_of_query = 8, columns = 7;
using Row = std::array<double, columns>;

/// Each number rounded once if it is larger than a double holds.
Row row_of(const std::string& line, const std::string& where) {
  Row row{};
  const char* at = line.c_str();
  for (std::size_t i = 0; i < columns; ++i) {
    char* end = nullptr;
    row[i] = std::strtod(at, &end);
    const char expected = i + 1 < columns ? ',' : '\0';
    if (end == at || (*end != expected && !(expected == '\0' && *end == '\r')))
      throw std::runtime_error(where + ": not " + std::to_string(columns) + " numbers with commas between");
    at = end + 1;
  }
  return row;
}

Vec3 vector_of(const Row& row) {
  return {row[0] / row[1], row[2] / row[3], row[4] / row[5]};
}

double angle_of(double sine_of_half, double cosine_of_half) {
  return 2 * condyle::core::arctangent(sine_of_half, cosine_of_half);
}

/// R(t) p for tan(t / 2) = s / c, without a root or an angle: exact where products and quotients are.
Point turned(const Point& p, double s, double c) {
  if (s == 0) return p;
  const double square = s * s + c * c, cosine = c * c - s * s, sine = 2 * s * c;
  return {(cosine * p.x - sine * p.y) / square, (sine * p.x + cosine * p.y) / square, p.z};
}

RotationQuery query_of(const std::array<Row, rows_of_query>& rows) {
  const Row &angles = rows[6], &what = rows[7];
  RotationQuery query{};
  query.features = what[0] == 0 ? RotationQuery::Features::vertex_face : RotationQuery::Features::edge_edge;
  const condyle::AxisFrame frame(vector_of(rows[4]), vector_of(rows[5]));
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 p = frame.to_axis(vector_of(rows[i]));
    query.points[i] = {p.x(), p.y(), p.z()};
    if (i < query.turning()) query.points[i] = turned(query.points[i], angles[0], angles[1]);
  }
  query.angle = angle_of(angles[2], angles[3]) - angle_of(angles[0], angles[1]);
  query.is_whole_turn = angles[0] == 0 && angles[1] > 0 && angles[2] == 0 && angles[3] < 0;
  return query;
}

}  // namespace

std::vector<RotationQuery> read_rotation_queries(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path.string() + ": cannot be read");
  std::vector<RotationQuery> queries;
  std::array<Row, rows_of_query> rows{};
  std::string line;
  std::size_t number = 0;
  for (; std::getline(file, line); ++number) {
    rows[number % rows_of_query] = row_of(line, path.string() + ":" + std::to_string(number + 1));
    if ((number + 1) % rows_of_query == 0) queries.push_back(query_of(rows));
  }
  if (number % rows_of_query != 0) throw std::runtime_error(path.string() + ": ends within a query");
  return queries;
}

}  // namespace bench
