#include <exception>
#include <numeric>
#include <thread>

#include "condyle/contact.hpp"
#include "condyle/pressure.hpp"
#include "contact/body_pair.hpp"
#include "contact/brute_pairs.hpp"
#include "mesh/edge_table.hpp"
#include "mesh/vertex_triangles.hpp"
#include "support/cup.hpp"
#include "support/random_pose.hpp"
#include "support/test.hpp"

/// Contacts that follow deforming bodies answer as those made anew.

namespace condyle::contact {
namespace {

/// A mesh that deforms at random: bumps that move whole regions, noise, and single vertices.
class Deforming {
 public:
  Deforming(TriMesh mesh, double size, unsigned seed)
      : now_(std::move(mesh)), first_(now_.vertices), size_(size), random_(seed) {}

  const TriMesh& mesh() const { return now_; }

  /// Every vertex moves from where it was at first.
  void move_all() {
    const Vec3 wave = size_ * vector(), phase = vector();
    for (std::size_t v = 0; v < first_.size(); ++v) {
      const Vec3 p = first_[v];
      now_.vertices.set(v, p + wave * std::sin(2 * p.normalized().dot(phase)) + 0.02 * size_ * vector());
    }
  }

  /// About one vertex in twenty moves; says which.
  std::vector<Index> move_some() {
    std::vector<Index> all(now_.vertices.size());
    std::iota(all.begin(), all.end(), Index{0});
    std::shuffle(all.begin(), all.end(), random_);
    all.resize(std::max<std::size_t>(1, all.size() / 20));
    for (const Index v : all) now_.vertices.set(v, first_[v] + 0.3 * size_ * vector());
    return all;
  }

  Points of(const std::vector<Index>& vertices) const {
    Points points;
    for (const Index v : vertices) points.push_back(now_.vertices[v]);
    return points;
  }

 private:
  Vec3 vector() { return {uniform_(random_), uniform_(random_), uniform_(random_)}; }

  TriMesh now_;
  Points first_;
  double size_;
  std::mt19937 random_;
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

/// By the number of the point: an updated contact keeps the order that it was made with.
radial::Penetrations sorted(const radial::Penetrations& given) {
  std::vector<std::size_t> order(given.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return given.point[a] < given.point[b]; });
  radial::Penetrations out;
  out.resize(given.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t from = order[i];
    out.point[i] = given.point[from], out.state[i] = given.state[from], out.winding[i] = given.winding[from];
    out.triangle[i] = given.triangle[from], out.depth_mm[i] = given.depth_mm[from];
    out.direction[i] = given.direction[from];
  }
  return out;
}

::testing::AssertionResult same(const std::optional<radial::Penetrations>& a,
                                const std::optional<radial::Penetrations>& b) {
  if (a.has_value() != b.has_value()) return ::testing::AssertionFailure() << "one has no inside";
  if (!a || sorted(*a) == sorted(*b)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << a->size() << " and " << b->size() << " vertices inside";
}

void expect_same(const JointContact& updated, const JointContact& anew, const Pose& X) {
  const Contact a = updated.at(X), b = anew.at(X);
  EXPECT_TRUE(same(a.mobile_in_fixed, b.mobile_in_fixed));
  EXPECT_TRUE(same(a.fixed_in_mobile, b.fixed_in_mobile));
  EXPECT_EQ(a.pairs, b.pairs);
  EXPECT_EQ(a.in_contact, b.in_contact);
  EXPECT_EQ(updated.in_contact(X), b.in_contact);
}

void expect_same(const SurfaceContact& a, const SurfaceContact& b) {
  ASSERT_EQ(a.faces.size(), b.faces.size());
  for (std::size_t i = 0; i < a.faces.size(); ++i) {
    const FaceContact &f = a.faces[i], &g = b.faces[i];
    EXPECT_EQ(f.face, g.face);
    EXPECT_EQ(f.area_mm2, g.area_mm2);
    EXPECT_EQ(f.max_depth_mm, g.max_depth_mm);
    EXPECT_EQ(f.overlap_mm3, g.overlap_mm3);
    EXPECT_EQ(f.load_n, g.load_n);
    EXPECT_EQ(f.load_moment, g.load_moment);
  }
  EXPECT_EQ(a.oblique_area_mm2, b.oblique_area_mm2);
  EXPECT_EQ(a.rim_faces, b.rim_faces);
  EXPECT_EQ(a.met_from_front, b.met_from_front);
  EXPECT_EQ(a.max_strain, b.max_strain);
}

void expect_same(const ElasticContactResults& a, const ElasticContactResults& b) {
  ASSERT_EQ(a.fixed.has_value(), b.fixed.has_value());
  ASSERT_EQ(a.mobile.has_value(), b.mobile.has_value());
  if (a.fixed) expect_same(*a.fixed, *b.fixed);
  if (a.mobile) expect_same(*a.mobile, *b.mobile);
  EXPECT_EQ(a.on_mobile.force_n, b.on_mobile.force_n);
  EXPECT_EQ(a.on_mobile.moment_nmm, b.on_mobile.moment_nmm);
  EXPECT_EQ(a.energy_nmm, b.energy_nmm);
}

/// Moves all or some vertices of one body of the contact, and of its mesh.
template <class Contact>
void step(int i, Deforming& fixed, Deforming& mobile, Contact& contact) {
  const BodyRole body = i % 2 ? BodyRole::fixed : BodyRole::mobile;
  Deforming& mesh = body == BodyRole::fixed ? fixed : mobile;
  if (i % 5 < 2) {
    mesh.move_all();
    contact.update(body, mesh.mesh().vertices);
  } else {
    const std::vector<Index> moved = mesh.move_some();
    contact.update(body, moved, mesh.of(moved));
  }
}

TEST(Update, AJointContactAnswersAsOneMadeAnewFor600RandomDeformations) {
  std::mt19937 random(11);
  std::size_t inside = 0, pairs = 0, apart = 0;
  for (const bool ball_moves : {true, false}) {
    Deforming fixed(test::socket({0.05, 0.1, 0}, 10, 13, 3), 0.8, 1);
    Deforming mobile(ball_moves ? test::sphere({0.02, 0, 0.01}, 9.8, 3) : test::torus(10.5, 1.2, 40, 12), 0.8,
                     2);
    JointContact contact(fixed.mesh(), mobile.mesh());
    for (int i = 0; i < 300; ++i) {
      if (i % 3 == 0) contact.radial(Pose::Identity());  // some tables are made, and follow
      step(i, fixed, mobile, contact);
      const JointContact anew(fixed.mesh(), mobile.mesh());
      const Pose X = test::random_pose(random, 0.3);
      expect_same(contact, anew, X);
      if (i % 100 == 0) {
        EXPECT_EQ(contact.radial(X).mobile_in_fixed, anew.radial(X).mobile_in_fixed);
        EXPECT_EQ(contact.tangential(X, Vec3::UnitZ()).mobile_in_fixed,
                  anew.tangential(X, Vec3::UnitZ()).mobile_in_fixed);
        EXPECT_EQ(contact.pairs(X), test::brute_pairs(fixed.mesh(), posed(X, mobile.mesh())));
      }
      const Contact found = anew.at(X);
      inside += found.mobile_in_fixed->size(), pairs += found.pairs.size(), apart += !found.in_contact;
      if (HasFailure()) FAIL() << "deformation " << i;
    }
  }
  EXPECT_GT(inside, 1000u);
  EXPECT_GT(pairs, 1000u);
}

TEST(Update, AnElasticContactAnswersAsOneMadeAnewFor400RandomDeformations) {
  std::mt19937 random(12);
  std::size_t faces = 0;
  const ElasticLayer layer{10, 0.4, 2.0};
  for (const Casting casting : {Casting::both, Casting::fixed}) {
    for (const FaceRule rule : {FaceRule::cut_faces, FaceRule::face_centre}) {
      // A closed socket, and an open sheet, with creases that come and go.
      const bool closed = casting == Casting::both;
      Deforming fixed(closed ? test::socket(Vec3::Zero(), 10, 13, 3) : test::cup(10, 3), 0.4, 3);
      Deforming mobile(test::sphere(Vec3::Zero(), 9.9, 3), 0.4, 4);
      const ElasticContactOptions options{
          .casting = casting, .rays = {.rule = rule}, .fixed = layer, .mobile = layer};
      ElasticContact contact(fixed.mesh(), mobile.mesh(), options);
      for (int i = 0; i < 100; ++i) {
        step(i, fixed, mobile, contact);
        const ElasticContact anew(fixed.mesh(), mobile.mesh(), options);
        // Asked often enough of one surface, what is inside is found first.
        for (int k = 0; k < (i % 25 == 0 ? 20 : 1); ++k) {
          const Pose X = test::random_pose(random, 0.2);
          const auto expected = anew.at(X);
          expect_same(contact.at(X), expected);
          faces += expected.fixed->faces.size();
        }
        if (HasFailure()) FAIL() << "deformation " << i;
      }
    }
  }
  EXPECT_GT(faces, 10000u);
}

TEST(Update, NormalDepthsFollowBothSurfaces) {
  Deforming casting(test::cup(10, 3), 0.4, 5), target(test::sphere(Vec3::Zero(), 9.9, 3), 0.4, 6);
  NormalDepth depth(casting.mesh(), target.mesh());
  for (int i = 0; i < 20; ++i) {
    casting.move_all();
    depth.update_casting(casting.mesh().vertices);
    const std::vector<Index> moved = target.move_some();
    depth.update_target(moved, target.of(moved));
    expect_same(depth.at(Pose::Identity()), NormalDepth(casting.mesh(), target.mesh()).at(Pose::Identity()));
  }
}

TEST(Update, ThicknessesStayWithTheirVertices) {
  Deforming fixed(test::cup(10, 3), 0.4, 7), mobile(test::sphere(Vec3::Zero(), 9.9, 3), 0.4, 8);
  std::vector<double> thickness(fixed.mesh().vertices.size());
  for (std::size_t v = 0; v < thickness.size(); ++v) thickness[v] = 1 + 0.001 * double(v);
  const ElasticContactOptions options{.casting = Casting::both, .fixed = ElasticLayer{10, 0.4, thickness}};
  ElasticContact contact(fixed.mesh(), mobile.mesh(), options);
  fixed.move_all();
  contact.update(BodyRole::fixed, fixed.mesh().vertices);
  const auto found = contact.at(Pose::Identity());
  expect_same(found, ElasticContact(fixed.mesh(), mobile.mesh(), options).at(Pose::Identity()));
  EXPECT_GT(found.on_mobile.force_n.norm(), 0);
}

TEST(Update, IsRefusedWhereItCannotBeTakenAndChangesNothing) {
  const TriMesh fixed = test::socket(Vec3::Zero(), 10, 13, 2), mobile = test::sphere({0, -0.2, 0}, 9.9, 2);
  JointContact contact(fixed, mobile);
  ElasticContact elastic(fixed, mobile, {.fixed = ElasticLayer{10, 0.4, 2.0}});
  const Contact before = contact.at(Pose::Identity());
  const auto forces_before = elastic.at(Pose::Identity());
  Points fewer = mobile.vertices, infinite = mobile.vertices;
  fewer.x.pop_back(), fewer.y.pop_back(), fewer.z.pop_back();
  infinite.x[5] = std::numeric_limits<double>::infinity();
  const std::vector<Index> beyond = {3, 9999}, twice = {3, 4, 3}, one = {3};
  const Points two(2), three(3);
  const auto both = [&](const auto& update) {
    const std::string of_joint = test::complaint_of([&] { update(contact); });
    EXPECT_EQ(test::complaint_of([&] { update(elastic); }), of_joint);
    return of_joint;
  };
  EXPECT_EQ(both([&](auto& c) { c.update(BodyRole::mobile, fewer); }), "an update of 66 vertices gives 65");
  EXPECT_EQ(both([&](auto& c) { c.update(BodyRole::mobile, infinite); }),
            "vertex 5 has a coordinate that is not finite");
  EXPECT_EQ(both([&](auto& c) { c.update(BodyRole::mobile, beyond, two); }),
            "an update moves vertex 9999 of 66");
  EXPECT_EQ(both([&](auto& c) { c.update(BodyRole::mobile, twice, three); }),
            "an update moves vertex 3 twice");
  EXPECT_EQ(both([&](auto& c) { c.update(BodyRole::mobile, one, two); }),
            "an update moves 1 vertices and gives 2 positions");
  // The ball is shifted so that its surface holds the joint centre.
  Points through_centre = mobile.vertices;
  for (double& x : through_centre.x) x += 9.9;
  for (double& y : through_centre.y) y += 0.2;
  EXPECT_NE(
      test::complaint_of([&] { contact.update(BodyRole::mobile, through_centre); }).find("mobile body: "),
      std::string::npos);
  const Contact after = contact.at(Pose::Identity());
  EXPECT_EQ(after.mobile_in_fixed, before.mobile_in_fixed);
  EXPECT_EQ(after.fixed_in_mobile, before.fixed_in_mobile);
  EXPECT_EQ(after.pairs, before.pairs);
  expect_same(elastic.at(Pose::Identity()), forces_before);
}

TEST(Update, OfOneContactLeavesAnotherThatSharesTheBody) {
  const TriMesh fixed = test::socket(Vec3::Zero(), 10, 13, 2), mobile = test::sphere(Vec3::Zero(), 9.9, 2);
  JointContact first(fixed, mobile);
  const Contact before = first.at(Pose::Identity());
  JointContact second(first, BodyRole::mobile, test::sphere({0, 0.3, 0}, 9.9, 2));
  Deforming moving(fixed, 0.5, 9);
  moving.move_all();
  second.update(BodyRole::fixed, moving.mesh().vertices);
  expect_same(second, JointContact(moving.mesh(), second.mobile()), Pose::Identity());
  const Contact after = first.at(Pose::Identity());
  EXPECT_EQ(after.mobile_in_fixed, before.mobile_in_fixed);
  EXPECT_EQ(after.pairs, before.pairs);
  EXPECT_EQ(first.fixed().arrays(), fixed);
}

TEST(Update, ATreeThatIsWornIsMadeAnew) {
  const Mesh mesh = test::sphere(Vec3::Zero(), 10, 4);
  mesh::TriangleTree tree(mesh);
  Points points = mesh.vertices();
  for (double& x : points.x) x *= 1.3;
  tree.refit(points);
  EXPECT_FALSE(tree.is_worn()) << "stretched, boxes grow with the root";
  std::mt19937 random(13);
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), random);
  for (std::size_t v = 0; v < order.size(); ++v) points.set(v, mesh.vertices()[order[v]]);
  tree.refit(points);
  EXPECT_TRUE(tree.is_worn()) << "neighbours of the tree are neighbours in space no more";
  BodyPair pair(mesh, mesh);
  pair.update(BodyRole::fixed, mesh.moved_to(points));
  EXPECT_EQ(pair.fixed_tree().nodes().size(), mesh::TriangleTree(mesh.moved_to(points)).nodes().size());
  EXPECT_EQ(pair.fixed_tree().mesh_triangles(), mesh::TriangleTree(mesh.moved_to(points)).mesh_triangles());
}

TEST(Update, AMeshThatMovedSharesWhatItsTrianglesAloneSay) {
  const Mesh mesh = test::sphere(Vec3::Zero(), 10, 1);
  const mesh::EdgeTable& edges = mesh::edges_of(mesh);
  Points points = mesh.vertices();
  points.x[0] += 1;
  const Mesh moved = mesh.moved_to(points);
  EXPECT_EQ(&mesh::edges_of(moved), &edges);
  EXPECT_EQ(&mesh::triangles_at_vertices_of(moved), &mesh::triangles_at_vertices_of(mesh));
  EXPECT_TRUE(moved.is_closed());
}

TEST(Update, IsSeenByEveryThreadThatAsksAfterIt) {
  Deforming fixed(test::socket(Vec3::Zero(), 10, 13, 2), 0.4, 16),
      mobile(test::sphere(Vec3::Zero(), 9.9, 2), 0.4, 17);
  const ElasticContactOptions options{.fixed = ElasticLayer{10, 0.4, 2.0}};
  JointContact joint(fixed.mesh(), mobile.mesh());
  ElasticContact elastic(fixed.mesh(), mobile.mesh(), options);
  for (int i = 0; i < 30; ++i) {
    Deforming& mesh = i % 2 ? fixed : mobile;
    const BodyRole body = i % 2 ? BodyRole::fixed : BodyRole::mobile;
    const std::vector<Index> moved = mesh.move_some();
    joint.update(body, moved, mesh.of(moved));
    elastic.update(body, moved, mesh.of(moved));
    std::vector<std::thread> threads;
    for (int k = 0; k < 4; ++k)
      threads.emplace_back([&] {
        expect_same(joint, JointContact(fixed.mesh(), mobile.mesh()), Pose::Identity());
        expect_same(elastic.at(Pose::Identity()),
                    ElasticContact(fixed.mesh(), mobile.mesh(), options).at(Pose::Identity()));
      });
    for (std::thread& thread : threads) thread.join();
  }
}

/// Resident memory of this process, kB.
long resident_kb() {
  std::ifstream status("/proc/self/statm");
  long all = 0, resident = 0;
  status >> all >> resident;
  return resident * 4;
}

/// CONDYLE_LONG_TESTS=1 makes a million updates, four in a step, else two thousand.
TEST(Update, MemoryIsFlat) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers keep freed memory";
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
  GTEST_SKIP() << "sanitizers keep freed memory";
#endif
#endif
  const int steps = std::getenv("CONDYLE_LONG_TESTS") ? 250000 : 500;
  Deforming fixed(test::socket(Vec3::Zero(), 10, 13, 1), 0.4, 14),
      mobile(test::sphere(Vec3::Zero(), 9.9, 1), 0.4, 15);
  JointContact joint(fixed.mesh(), mobile.mesh());
  ElasticContact elastic(fixed.mesh(), mobile.mesh(), {.fixed = ElasticLayer{10, 0.4, 2.0}});
  long settled = 0;
  for (int i = 0; i < steps; ++i) {
    Deforming& mesh = i % 2 ? fixed : mobile;
    const BodyRole body = i % 2 ? BodyRole::fixed : BodyRole::mobile;
    mesh.move_all();
    joint.update(body, mesh.mesh().vertices);
    elastic.update(body, mesh.mesh().vertices);
    const std::vector<Index> moved = mesh.move_some();
    joint.update(body, moved, mesh.of(moved));
    elastic.update(body, moved, mesh.of(moved));
    joint.at(Pose::Identity());
    elastic.at(Pose::Identity());
    if (i == steps / 10) settled = resident_kb();
  }
  EXPECT_LT(resident_kb(), settled + 1024) << "kB after " << steps / 10 << " of " << steps << " steps";
}

}  // namespace
}  // namespace condyle::contact
