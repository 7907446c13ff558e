#include "io/model/model_ligament_lines.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>

#include "io/file/in_quotes.hpp"
#include "io/joint/ligament_tables.hpp"

namespace condyle::io {
namespace {

/// What is not to be a string between the two bodies, and why.
struct LeftOut {
  std::string why;
};

class LigamentLines {
 public:
  LigamentLines(const Model& model, const RoleOfBody& role_of_body, std::vector<ModelNote>& notes)
      : model_(model), role_of_body_(role_of_body), notes_(notes) {}

  std::string text() {
    std::vector<Ligament> ligaments;
    std::set<std::string> names;
    for (const ModelLigament& each : model_.ligaments) {
      if (!joins_bodies(each)) continue;
      try {
        if (!each.applies) throw LeftOut{"it is not applied in the model"};
        if (names.contains(each.name)) throw LeftOut{"another one has its name"};
        ligaments.push_back(ligament_of(each));
        names.insert(each.name);
      } catch (const LeftOut& left_out) {
        notes_.push_back({ModelNoteCode::ligament_left_out,
                          fmt::format("ligament {} is left out: {}", in_quotes(each.name), left_out.why)});
      }
    }
    if (!cylinders_.empty())
      notes_.push_back(
          {ModelNoteCode::endless_cylinder,
           fmt::format("ligaments wrap cylinders without ends here: {}", fmt::join(cylinders_, ", "))});
    return ligaments_text(ligaments, 1);
  }

 private:
  std::optional<BodyRole> role_of(const ModelLigament::Point& point) const {
    const auto found = role_of_body_.find(point.body);
    return found == role_of_body_.end() ? std::nullopt : std::optional(found->second.first);
  }

  /// Whether it has points on both bodies, whatever else.
  bool joins_bodies(const ModelLigament& ligament) const {
    const auto on = [&](BodyRole role) {
      return std::any_of(ligament.points.begin(), ligament.points.end(),
                         [&](const auto& point) { return role_of(point) == role; });
    };
    return on(BodyRole::fixed) && on(BodyRole::mobile);
  }

  Ligament ligament_of(const ModelLigament& of) {
    Ligament ligament{.name = of.name,
                      .slack_length_mm = of.slack_length,
                      .stiffness_n = of.stiffness_n,
                      .transition_strain = of.transition_strain,
                      .damping_n_s = of.damping_n_s};
    std::optional<BodyRole> before;
    int crossings = 0;
    for (const ModelLigament::Point& point : of.points) {
      const auto role = role_of(point);
      if (!role) throw LeftOut{fmt::format("it has a point on another body, {}", in_quotes(point.body))};
      crossings += before && before != role;
      before = role;
      (*role == BodyRole::fixed ? ligament.fixed : ligament.mobile)
          .push_back(posed(role_of_body_.at(point.body).second, point.p));
    }
    if (crossings > 1) throw LeftOut{fmt::format("it crosses the joint {} times", crossings)};
    // From the insertion on: of the body that its path ends on in the other order.
    auto& last = before == BodyRole::fixed ? ligament.fixed : ligament.mobile;
    std::reverse(last.begin(), last.end());
    add_wrap(of, ligament);
    return ligament;
  }

  void add_wrap(const ModelLigament& of, Ligament& ligament) {
    for (const std::string& name : of.wraps) {
      const auto same = [&](const ModelWrap& wrap) { return wrap.name == name; };
      const auto found = std::find_if(model_.wraps.begin(), model_.wraps.end(), same);
      const std::string quoted = in_quotes(name);
      if (found == model_.wraps.end()) throw LeftOut{fmt::format("there is no surface {} to wrap", quoted)};
      if (std::find_if(found + 1, model_.wraps.end(), same) != model_.wraps.end())
        throw LeftOut{fmt::format("two surfaces are called {}", quoted)};
      if (!found->is_active) continue;
      if (!found->why_not.empty()) throw LeftOut{found->why_not};
      if (ligament.wrap) throw LeftOut{"it wraps more than one surface"};
      const auto role = role_of_body_.find(found->body);
      if (role == role_of_body_.end())
        throw LeftOut{fmt::format("it wraps {} of another body, {}", quoted, in_quotes(found->body))};
      if (found->quadrant != "all")
        throw LeftOut{fmt::format("it wraps the half {} of {}", in_quotes(found->quadrant), quoted)};
      ligament.wrap = wrap_of(*found, role->second.first, role->second.second * found->X_BW);
    }
  }

  LigamentWrap wrap_of(const ModelWrap& of, BodyRole body, const Pose& X) {
    LigamentWrap wrap{.body = body, .centre = X.translation(), .radius_mm = of.radii.x()};
    const bool is_ellipsoid = of.type == "WrapEllipsoid";
    if (is_ellipsoid) {
      wrap.shape = WrapShape::ellipsoid;
      wrap.axes = X.linear();
      wrap.radii_mm = of.radii;
    } else if (of.type == "WrapCylinder") {
      wrap.shape = WrapShape::cylinder;
      wrap.axis = X.linear().col(2);
      if (std::find(cylinders_.begin(), cylinders_.end(), of.name) == cylinders_.end())
        cylinders_.push_back(of.name);
    } else if (of.type != "WrapSphere") {
      throw LeftOut{fmt::format("it wraps {}, a {}", in_quotes(of.name), of.type)};
    }
    if (!((is_ellipsoid ? of.radii.minCoeff() : of.radii.x()) > 0))
      throw LeftOut{fmt::format("{} has no size", in_quotes(of.name))};
    return wrap;
  }

  const Model& model_;
  const RoleOfBody& role_of_body_;
  std::vector<ModelNote>& notes_;
  std::vector<std::string> cylinders_;
};

}  // namespace

std::string ligament_lines(const Model& model, const RoleOfBody& role_of_body,
                           std::vector<ModelNote>& notes) {
  return LigamentLines(model, role_of_body, notes).text();
}

}  // namespace condyle::io
