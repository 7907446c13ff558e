#include <algorithm>

#include "arrays.hpp"
#include "bindings.hpp"
#include "condyle/answer.hpp"
#include "core/parallel.hpp"
#include "interrupts.hpp"
#include "joint.hpp"

namespace condyle::python {
namespace {

/// Poses computed at once, between two looks for Ctrl-C: some tens of milliseconds on large bones.
constexpr std::size_t poses_at_once = 256;

/// The vertices that are not outside, of one pose after the other: pose n owns [offset[n], offset[n + 1]).
struct VertexLists {
  std::vector<std::int64_t> offset{0};
  std::vector<Index> vertex, triangle;
  std::vector<std::int8_t> state, direction;
  std::vector<std::int32_t> winding;
  std::vector<double> depth_mm, depth_deg;

  void end_pose() { offset.push_back(static_cast<std::int64_t>(vertex.size())); }

  void append(const radial::Penetrations& from) {
    const auto add = [](auto& to, const auto& values) { to.insert(to.end(), values.begin(), values.end()); };
    add(vertex, from.point);
    add(triangle, from.triangle);
    add(winding, from.winding);
    add(depth_mm, from.depth_mm);
    const std::size_t first = state.size();
    state.resize(first + from.size());
    direction.resize(first + from.size());
    for (std::size_t i = 0; i < from.size(); ++i) {
      state[first + i] = static_cast<std::int8_t>(from.state[i]);
      direction[first + i] = from.direction[i] == radial::RayDirection::away_from_centre ? 1 : -1;
    }
    end_pose();
  }

  void append(const tangential::TangentialResults& from) {
    for (std::size_t v = 0; v < from.size(); ++v) {
      if (from.state[v] == PointState::outside) continue;
      vertex.push_back(static_cast<Index>(v));
      triangle.push_back(from.triangle[v]);
      state.push_back(static_cast<std::int8_t>(from.state[v]));
      direction.push_back(static_cast<std::int8_t>(from.rotation_sense[v]));
      winding.push_back(from.winding[v]);
      // 0 of -0, which a point on the surface would have.
      depth_mm.push_back(0.0 - from.arc_gap_mm[v]);
      depth_deg.push_back(0.0 - from.angular_gap[v].degrees());
    }
    end_pose();
  }
};

/// Columns that keep the lists alive.
py::object vertices_dict(bool is_asked, VertexLists&& lists, bool with_angles) {
  if (!is_asked) return py::none();
  auto kept = std::make_unique<VertexLists>(std::move(lists));
  const VertexLists& of = *kept;
  const py::capsule owner(kept.release(), [](void* pointer) { delete static_cast<VertexLists*>(pointer); });
  const auto column = [&](const auto& values) {
    return view_of(values.data(), {static_cast<py::ssize_t>(values.size())},
                   {static_cast<py::ssize_t>(sizeof values[0])}, owner);
  };
  py::dict dict;
  dict["offset"] = column(of.offset);
  dict["vertex"] = column(of.vertex);
  dict["state"] = column(of.state);
  dict["winding"] = column(of.winding);
  dict["triangle"] = column(of.triangle);
  dict["depth_mm"] = column(of.depth_mm);
  dict["direction"] = column(of.direction);
  if (with_angles) dict["depth_deg"] = column(of.depth_deg);
  return dict;
}

const contact::JointContact& contact_of(const JointHandle& handle) {
  return handle.contact;
}
const contact::JointContact& contact_of(const contact::JointContact& contact) {
  return contact;
}

template <class Bodies>
py::tuple radial(const Bodies& bodies, const py::object& given, bool of_mobile, bool of_fixed,
                 const py::object& progress) {
  const PosesIn in = poses_in(given, "pose");
  VertexLists mobile, fixed;
  Follower follower(progress, in.poses.size());
  {
    const py::gil_scoped_release released;
    const contact::JointContact& contact = contact_of(bodies);
    of_mobile = of_mobile && contact.fixed().is_closed();
    of_fixed = of_fixed && contact.mobile().is_closed();
    std::vector<radial::Penetrations> mobile_now(std::min(in.poses.size(), poses_at_once)),
        fixed_now(mobile_now.size());
    for (std::size_t first = 0; first < in.poses.size(); first += poses_at_once) {
      const std::size_t count = std::min(poses_at_once, in.poses.size() - first);
      const auto ask = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          if (of_mobile) contact.mobile_in_fixed(in.poses[first + i], mobile_now[i]);
          if (of_fixed) contact.fixed_in_mobile(in.poses[first + i], fixed_now[i]);
        }
      };
      if (count == 1)
        ask(0, 1);
      else
        core::parallel_chunks(count, 8, ask);
      for (std::size_t i = 0; i < count; ++i) {
        if (of_mobile) mobile.append(mobile_now[i]);
        if (of_fixed) fixed.append(fixed_now[i]);
      }
      if (in.poses.size() > 1) follower.poll(first + count);
    }
  }
  return py::make_tuple(in.is_one, vertices_dict(of_mobile, std::move(mobile), false),
                        vertices_dict(of_fixed, std::move(fixed), false));
}

py::tuple tangential(const JointHandle& handle, const py::object& given, const py::object& given_about,
                     const py::object& progress) {
  const PosesIn in = poses_in(given, "pose");
  const contact::ArcsAbout about = about_in(given_about);
  const CoordinateSystem system = handle.joint().coordinates();
  VertexLists mobile, fixed;
  const bool of_mobile = handle.contact.fixed().is_closed(), of_fixed = handle.contact.mobile().is_closed();
  Follower follower(progress, in.poses.size());
  {
    const py::gil_scoped_release released;
    for (std::size_t n = 0; n < in.poses.size(); ++n) {
      const Pose& X_FM = in.poses[n];
      check_depth_request(handle.joint(), {.X_FM = X_FM, .method = DepthMethod::tangential, .about = about});
      const contact::TangentialContact contact =
          handle.contact.tangential(X_FM, line_of(about, system, angles_at(system, X_FM)));
      if (of_mobile) mobile.append(*contact.mobile_in_fixed);
      if (of_fixed) fixed.append(*contact.fixed_in_mobile);
      follower.poll(n + 1);
    }
  }
  return py::make_tuple(in.is_one, vertices_dict(of_mobile, std::move(mobile), true),
                        vertices_dict(of_fixed, std::move(fixed), true));
}

/// (K, 2) pairs of all poses, pose n owning [offset[n], offset[n + 1]).
template <class Bodies>
py::tuple pairs(const Bodies& bodies, const py::object& given, const py::object& progress) {
  const PosesIn in = poses_in(given, "pose");
  std::vector<contact::TrianglePair> all;
  std::vector<std::int64_t> offset{0};
  Follower follower(progress, in.poses.size());
  {
    const py::gil_scoped_release released;
    for (std::size_t n = 0; n < in.poses.size(); ++n) {
      const std::vector<contact::TrianglePair> found = contact_of(bodies).pairs(in.poses[n]);
      all.insert(all.end(), found.begin(), found.end());
      offset.push_back(static_cast<std::int64_t>(all.size()));
      follower.poll(n + 1);
    }
  }
  static_assert(sizeof(contact::TrianglePair) == 2 * sizeof(Index));
  auto kept = std::make_unique<std::vector<contact::TrianglePair>>(std::move(all));
  const auto count = static_cast<py::ssize_t>(kept->size());
  const Index* data = kept->empty() ? nullptr : &kept->front().fixed;
  const py::capsule owner(kept.release(),
                          [](void* p) { delete static_cast<std::vector<contact::TrianglePair>*>(p); });
  constexpr auto size = static_cast<py::ssize_t>(sizeof(Index));
  return py::make_tuple(in.is_one, view_of(data, {count, 2}, {2 * size, size}, owner),
                        array_of(std::move(offset)));
}

template <class Bodies>
py::tuple in_contact(const Bodies& bodies, const py::object& given, const py::object& progress) {
  const PosesIn in = poses_in(given, "pose");
  py::array_t<bool> answers(static_cast<py::ssize_t>(in.poses.size()));
  bool* answer = answers.mutable_data();
  Follower follower(progress, in.poses.size());
  {
    const py::gil_scoped_release released;
    for (std::size_t n = 0; n < in.poses.size(); ++n) {
      answer[n] = contact_of(bodies).in_contact(in.poses[n]);
      follower.poll(n + 1);
    }
  }
  return py::make_tuple(in.is_one, answers);
}

}  // namespace

void bind_penetration(py::module_& module) {
  module.def("penetration_radial", &radial<JointHandle>);
  module.def("penetration_tangential", &tangential);
  module.def("pairs", &pairs<JointHandle>);
  module.def("in_contact", &in_contact<JointHandle>);
  using contact::JointContact;
  const auto role = [](bool is_fixed) { return is_fixed ? BodyRole::fixed : BodyRole::mobile; };
  py::class_<JointContact>(module, "JointContact")
      .def(py::init([](const Mesh& fixed, const Mesh& mobile) {
        return std::make_unique<JointContact>(fixed, mobile);
      }))
      .def("radial", &radial<JointContact>)
      .def("pairs", &pairs<JointContact>)
      .def("in_contact", &in_contact<JointContact>)
      .def("update",
           [role](JointContact& contact, bool is_fixed, const py::object& given) {
             const PointsIn vertices(given, "vertices");
             const py::gil_scoped_release released;
             contact.update(role(is_fixed), vertices.view());
           })
      .def("update_some",
           [role](JointContact& contact, bool is_fixed, const py::object& moved, const py::object& given) {
             const PointsIn positions(given, "vertices");
             const std::vector<Index> vertices = vertices_in(moved, "moved", positions.size());
             const py::gil_scoped_release released;
             contact.update(role(is_fixed), vertices, positions.view());
           })
      .def_property_readonly("fixed", &JointContact::fixed)
      .def_property_readonly("mobile", &JointContact::mobile);
}

}  // namespace condyle::python
