#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <functional>
#include <vector>

#include "condyle/contact.hpp"
#include "condyle/pressure.hpp"
#include "goals.hpp"
#include "questions.hpp"
#include "timing.hpp"

namespace bench {
namespace {

using condyle::BodyRole;
using condyle::Index;
using condyle::Mesh;
using condyle::Points;
using condyle::Pose;
namespace contact = condyle::contact;

const TableHead deforming_head{
    "deforming",
    "A fixed body that deforms in each step: updating, rebuilding, and trees that others refit; one thread",
    {{"scene", "scene"},
     {"question", "question"},
     {"fixed_vertices", "fixed vertices"},
     {"making_ms", "making, ms"},
     {"update_ms", "update of all, ms"},
     {"some_ms", "of one in a hundred, ms"},
     {"ratio", "making over update"},
     {"steps", "steps a second"},
     {"steps_of_some", "steps, one in a hundred"},
     {"steps_rebuilding", "steps, rebuilding"},
     {"peer", "beside"},
     {"peer_steps", "its steps a second"}}};

/// Frames of the deformation, gone through again and again, each with a pose of its own.
constexpr int frame_count = 6;

/// One hundredth of the vertices, neighbours in number.
struct SomeVertices {
  std::vector<Index> numbers;
  Points positions;

  SomeVertices(const Points& all, int frame) {
    const std::size_t count = std::max<std::size_t>(1, all.size() / 100);
    const std::size_t first = all.size() / frame_count * static_cast<std::size_t>(frame);
    for (std::size_t i = first; i < std::min(first + count, all.size()); ++i) {
      numbers.push_back(static_cast<Index>(i));
      positions.push_back(all[i]);
    }
  }
};

/// What is asked in each step. A contact that has been asked once has made what it needs.
struct DeformingQuestion {
  std::string question;
  std::function<void(const Points&, const Pose&)> make;
  std::function<void(const Pose&)> ask;
  std::function<void(const Points&)> update;
  std::function<void(const SomeVertices&)> update_some;
  std::string peer;  ///< a method, which answers the nearest thing
  std::function<void(Method&, const Pose&)> ask_peer;
};

template <class Contact>
DeformingQuestion deforming(std::string question, Contact& kept,
                            const std::function<Contact(const Mesh&)>& made,
                            const std::function<void(const Contact&, const Pose&)>& ask) {
  return {std::move(question),
          [made, ask, &kept](const Points& now, const Pose& X_FM) {
            ask(made(kept.fixed().moved_to(now)), X_FM);
          },
          [&kept, ask](const Pose& X_FM) { ask(kept, X_FM); },
          [&kept](const Points& all) { kept.update(BodyRole::fixed, all); },
          [&kept](const SomeVertices& some) { kept.update(BodyRole::fixed, some.numbers, some.positions); },
          "",
          {}};
}

class Measured {
 public:
  Measured(const Scene& scene, Effort effort, Report& report)
      : scene_(scene), effort_(effort), report_(report) {
    const Points& rest = fixed().vertices;
    for (int frame = 0; frame < frame_count; ++frame) {
      all_.push_back(deformed(rest, frame + 1));
      some_.emplace_back(all_.back(), frame);
    }
  }

  void operator()(const DeformingQuestion& asked) {
    const auto kind = asked.peer.empty() ? std::nullopt : method_named(asked.peer);
    const auto peer = kind ? kind->make({fixed(), scene_.joint.mobile.mesh}) : nullptr;
    const auto each = [](const auto& step) {
      return [step] {
        for (int frame = 0; frame < frame_count; ++frame) step(static_cast<std::size_t>(frame));
      };
    };
    const auto X = [&](std::size_t frame) { return scene_.poses[frame].X_FM; };
    std::vector<std::vector<double>> samples;
    tbb::task_arena(1).execute([&] {
      samples = interleaved(
          effort_ == Effort::full ? 7 : 1,
          {each([&](std::size_t f) { asked.make(all_[f], X(f)); }),
           each([&](std::size_t f) { asked.ask(X(f)); }), each([&](std::size_t f) { asked.update(all_[f]); }),
           each([&](std::size_t f) { asked.update(all_[f]), asked.ask(X(f)); }),
           each([&](std::size_t f) { asked.update_some(some_[f]); }),
           each([&](std::size_t f) { asked.update_some(some_[f]), asked.ask(X(f)); }),
           each([&](std::size_t f) {
             if (peer) peer->deform(all_[f]), asked.ask_peer(*peer, X(f));
           })});
    });
    const auto seconds = [&](std::size_t way) { return median(samples[way]) / frame_count; };
    const double making = seconds(0) - seconds(1), update = seconds(2), some = seconds(4);
    report_.table(deforming_head)
        .add({scene_.joint.name, asked.question, std::int64_t(fixed().vertices.size()), making * 1e3,
              update * 1e3, some * 1e3, making / update, 1 / seconds(3), 1 / seconds(5), 1 / seconds(0),
              peer ? kind->title : std::string("-"), peer ? Cell(1 / seconds(6)) : Cell("-")});
    if (effort_ != Effort::full) return;
    add_goal({"update of all vertices, " + asked.question, scene_.joint.name, Bound::at_most, 10, "ms"},
             update * 1e3, report_);
    add_goal(
        {"update of one vertex in a hundred, " + asked.question, scene_.joint.name, Bound::at_most, 1, "ms"},
        some * 1e3, report_);
  }

 private:
  const condyle::TriMesh& fixed() const { return scene_.joint.fixed.mesh; }

  const Scene& scene_;
  Effort effort_;
  Report& report_;
  std::vector<Points> all_;
  std::vector<SomeVertices> some_;
};

}  // namespace

void ask_deforming(const Scene& scene, Effort effort, Report& report) {
  const Mesh fixed(scene.joint.fixed.mesh), mobile(scene.joint.mobile.mesh);
  Measured measure(scene, effort, report);
  const auto joint = [&](const Mesh& now) { return contact::JointContact(now, mobile); };
  std::vector<contact::TrianglePair> pairs;
  std::vector<InsideVertex> inside;
  condyle::radial::Penetrations found;

  contact::JointContact of_inside = joint(fixed), of_pairs = joint(fixed), of_both = joint(fixed);
  DeformingQuestion vertices = deforming<contact::JointContact>(
      "vertices inside and depths", of_inside, joint,
      [&](const contact::JointContact& c, const Pose& X) { c.mobile_in_fixed(X, found); });
  vertices.peer = "embree_16_robust";
  vertices.ask_peer = [&](Method& method, const Pose& X) { method.find_inside(X, inside); };
  DeformingQuestion triangles = deforming<contact::JointContact>(
      "pairs of triangles", of_pairs, joint,
      [](const contact::JointContact& c, const Pose& X) { (void)c.pairs(X); });
  triangles.peer = "fcl_obbrss";
  triangles.ask_peer = [&](Method& method, const Pose& X) { method.find_pairs(X, pairs); };
  const DeformingQuestion both =
      deforming<contact::JointContact>("vertices of both bodies, and pairs", of_both, joint,
                                       [](const contact::JointContact& c, const Pose& X) { (void)c.at(X); });
  const auto layered = [&](const Mesh& now) {
    const contact::ElasticLayer layer{12, 0.42, 1.6};
    return contact::ElasticContact(now, mobile, {.fixed = layer, .mobile = layer});
  };
  contact::ElasticContact of_pressure = layered(fixed);
  const DeformingQuestion pressure = deforming<contact::ElasticContact>(
      "pressure", of_pressure, layered,
      [](const contact::ElasticContact& c, const Pose& X) { (void)c.at(X); });
  for (const DeformingQuestion& asked : {vertices, triangles, both, pressure}) measure(asked);
}

}  // namespace bench
