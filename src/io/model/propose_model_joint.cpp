#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "condyle/error.hpp"
#include "condyle/io/model_file.hpp"
#include "condyle/io/pose_text.hpp"
#include "condyle/version.hpp"
#include "core/near_name.hpp"
#include "core/one_line.hpp"
#include "io/file/format_version.hpp"
#include "io/file/in_quotes.hpp"
#include "io/file/path_from.hpp"
#include "io/joint/load_joint.hpp"
#include "io/joint/proposal_lines.hpp"
#include "io/mesh/parse.hpp"
#include "io/mesh/polygon_rule.hpp"
#include "io/model/joint_mapping.hpp"
#include "io/model/model_contact_lines.hpp"
#include "io/model/model_joint_file.hpp"
#include "io/model/model_ligament_lines.hpp"
#include "io/model/spatial_transform.hpp"
#include "io/model/welded_bodies.hpp"
#include "io/motion/column_zero.hpp"

namespace condyle::io {
namespace {

namespace fs = std::filesystem;

std::string toml_numbers(const Vec3& v) {
  return fmt::format("[{}, {}, {}]", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);  // no -0
}

std::string toml_pose(const Pose& X) {
  std::vector<double> rows;
  for (int i = 0; i < 16; ++i) rows.push_back(X.matrix()(i / 4, i % 4) + 0.0);
  return fmt::format("[{}]", fmt::join(rows, ", "));
}

/// Bones of people of other sizes are scaled by 0.7 to 1.3 along each axis.
constexpr double most_uneven_scale = 2;

/// The names, or the first of very many.
std::string some_of(std::vector<std::string> names) {
  constexpr std::size_t most_named = 20;
  const std::size_t more = names.size() - std::min(names.size(), most_named);
  names.resize(names.size() - more);
  return fmt::format("{}{}", fmt::join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

/// A mesh of a body under the name that it has among the others.
struct NamedMesh {
  std::string name;
  ModelMesh mesh;
};

/// The meshes of a body, found by what they are and by name.
class BodyMeshes {
 public:
  /// One of the same file in the same place, to rounding; null if there is none.
  const NamedMesh* find(const ModelMesh& mesh) const {
    const auto alike = places_.find(kind_of(mesh));
    if (alike == places_.end()) return nullptr;
    // Matrices that are the same have sums that differ by no more than this.
    const double sum = sum_of(mesh), off = 1e-10 * mesh.X_BG.matrix().norm();
    for (auto at = alike->second.lower_bound(sum - off); at != alike->second.end() && at->first <= sum + off;
         ++at)
      if (meshes_[at->second].mesh.X_BG.isApprox(mesh.X_BG, 1e-12)) return &meshes_[at->second];
    return nullptr;
  }

  /// Under that name, or with a number behind it if it is taken.
  const NamedMesh& add(const ModelMesh& mesh, const std::string& name) {
    std::string free = name;
    for (int& n = last_number_.try_emplace(name, 1).first->second; !names_.insert(free).second;)
      free = fmt::format("{}_{}", name, ++n);
    if (const double sum = sum_of(mesh); std::isfinite(sum))
      places_[kind_of(mesh)].emplace(sum, meshes_.size());
    return meshes_.emplace_back(NamedMesh{std::move(free), mesh});
  }

  std::vector<NamedMesh>& all() noexcept { return meshes_; }
  const std::vector<NamedMesh>& all() const noexcept { return meshes_; }

 private:
  using Kind = std::tuple<std::string, double, double, double>;

  static Kind kind_of(const ModelMesh& mesh) {
    return {mesh.file, mesh.scale.x(), mesh.scale.y(), mesh.scale.z()};
  }

  /// Sums the elements of the matrix with weights that tell places apart.
  static double sum_of(const ModelMesh& mesh) {
    double sum = 0;
    for (int i = 0; i < 12; ++i) sum += std::sqrt(i + 2.0) * mesh.X_BG.matrix()(i / 4, i % 4);
    return sum;
  }

  std::vector<NamedMesh> meshes_;
  std::map<Kind, std::multimap<double, std::size_t>> places_;
  std::set<std::string> names_;
  std::map<std::string, int> last_number_;
};

/// Writes the joint file of a model's joint.
class ModelJointFile {
 public:
  ModelJointFile(const Model& model, const ModelJointRequest& request)
      : model_(model), request_(request), joint_(joint_named(model, request.joint)) {
    if (joint_.coordinates.empty())
      throw FileError(fmt::format("{}: line {}: joint {}: it has no coordinates and does not move",
                                  model.path.string(), joint_.line, in_quotes(joint_.name)));
    anatomy_ = request.anatomy ? request.anatomy : io::anatomy_of(joint_);
    const auto side = request.side ? request.side : io::side_of(joint_);
    if (!side)
      throw UsageError(fmt::format(
          "{}: joint {}: its name and its bodies' names do not agree on one side, _r or _l: give its side",
          model.path.string(), in_quotes(joint_.name)));
    side_ = *side;
    mapping_ = mapping_of(StandingModel(model_), joint_, anatomy_, side_);
    if (const ModelCoupler* coupler = coupler_of_joint(); coupler && !mapping_.columns.empty()) {
      mapping_.columns.clear();
      mapping_.why += fmt::format("; constraint {} moves it too", in_quotes(coupler->name));
    }
    if (!anatomy_ && mapping_.kind != JointKind::hinge)
      throw UsageError(
          fmt::format("{}: joint {}: its names are of no joint known here: say whether it is a hip, knee, "
                      "ankle, elbow or shoulder",
                      model.path.string(), in_quotes(joint_.name)));
    const WeldedBodies welded(model_);
    fixed_bodies_ = welded.of(joint_, BodyRole::fixed);
    mobile_bodies_ = welded.of(joint_, BodyRole::mobile);
    require_two_bodies();
    for (const BodyRole role : {BodyRole::fixed, BodyRole::mobile}) {
      for (const WeldedBody& body : bodies_of_role(role))
        role_of_body_.emplace(body.name, std::pair(role, body.X));
      for (const ModelMesh& mesh : welded.meshes_of(joint_, role)) add_once(meshes_of_role(role), mesh);
    }
    for (const ModelContactMesh& mesh : model_.contact_meshes) contact_meshes_[mesh.name].push_back(&mesh);
    choose_contact();
    leave_out_missing();
  }

  ModelJointProposal proposal() {
    require_finite();
    write_head();
    write_body("fixed", joint_.parent_body, fixed_.all(), std::nullopt);
    write_body("mobile", joint_.child_body, mobile_.all(),
               pose_of(joint_, std::vector<double>(joint_.coordinates.size())));
    write_frame();
    write_reference_pose();
    write_contact();
    text_ += ligament_lines(model_, role_of_body_, out_.notes);
    write_recorded_motion();
    note_what_is_left_out();
    out_.proposal.toml = std::move(text_);
    out_.proposal.side = side_;
    return std::move(out_);
  }

 private:
  void add(const std::string& line) { text_ += line + "\n"; }
  void note(ModelNoteCode code, std::string line) { out_.notes.push_back({code, std::move(line)}); }

  std::string path_of(const fs::path& file) const {
    return path_from(request_.joint_file.empty() ? fs::path("joint.toml") : request_.joint_file, file);
  }

  BodyMeshes& meshes_of_role(BodyRole role) { return role == BodyRole::fixed ? fixed_ : mobile_; }
  const std::vector<WeldedBody>& bodies_of_role(BodyRole role) const {
    return role == BodyRole::fixed ? fixed_bodies_ : mobile_bodies_;
  }

  const ModelCoupler* coupler_of_joint() const {
    for (const ModelCoupler& coupler : model_.couplers)
      for (const ModelCoordinate& coordinate : joint_.coordinates)
        if (coordinate.name == coupler.dependent) return &coupler;
    return nullptr;
  }

  void require_two_bodies() const {
    std::set<std::string_view> fixed;
    for (const WeldedBody& body : fixed_bodies_) fixed.insert(body.name);
    const auto is_fixed_too = [&](const WeldedBody& body) { return fixed.contains(body.name); };
    const auto both = std::find_if(mobile_bodies_.begin(), mobile_bodies_.end(), is_fixed_too);
    if (both != mobile_bodies_.end())
      throw FileError(fmt::format("{}: line {}: joint {}: body {} is on both sides of it",
                                  model_.path.string(), joint_.line, in_quotes(joint_.name),
                                  in_quotes(both->name)));
  }

  /// Missing meshes, unless all of a body's are missing.
  void leave_out_missing() {
    for (std::vector<NamedMesh>* meshes : {&fixed_.all(), &mobile_.all()}) {
      const auto is_missing = [](const NamedMesh& named) { return !named.mesh.path; };
      if (std::all_of(meshes->begin(), meshes->end(), is_missing)) continue;
      for (const NamedMesh& named : *meshes)
        if (is_missing(named))
          note(ModelNoteCode::missing_mesh,
               fmt::format("mesh {} of body {} is missing and left out; it was looked for as {}",
                           in_quotes(named.mesh.file), in_quotes(named.mesh.body),
                           fmt::join(names_of(named.mesh.looked_in), ", ")));
      std::erase_if(*meshes, is_missing);
    }
  }

  static std::vector<std::string> names_of(const std::vector<fs::path>& paths) {
    std::vector<std::string> names;
    for (const fs::path& path : paths) names.push_back(path.string());
    return names;
  }

  void add_once(BodyMeshes& meshes, const ModelMesh& mesh) {
    if (!meshes.find(mesh)) {
      add_mesh(meshes, mesh, fs::path(mesh.file).stem().string());
      return;
    }
    note(ModelNoteCode::repeated_mesh,
         fmt::format("mesh {} is attached to body {} twice in one place, and taken once",
                     in_quotes(mesh.file), in_quotes(mesh.body)));
  }

  const NamedMesh& add_mesh(BodyMeshes& meshes, const ModelMesh& mesh, const std::string& name) const {
    if (mesh.scale.cwiseAbs().minCoeff() == 0)
      throw FileError(fmt::format("{}: line {}: mesh {}: scale_factors: a factor of 0 leaves no solid",
                                  model_.path.string(), mesh.line, in_quotes(mesh.file)));
    return meshes.add(mesh, name.empty() ? "mesh" : name);
  }

  /// A joint file holds finite numbers only, and lengths of it are computed in mm.
  void require_finite() const {
    constexpr double largest = 1e6;  // m
    bool holds = mapping_.X_WF.matrix().cwiseAbs().maxCoeff() < largest;
    const Pose X = pose_of(joint_, std::vector<double>(joint_.coordinates.size()));
    holds &= X.matrix().cwiseAbs().maxCoeff() < largest;
    for (const ColumnOfCoordinate& column : mapping_.columns)
      holds &= std::abs(column.offset) < 1000 * largest && std::abs(*column.otherwise) < 1000 * largest;
    for (const auto* meshes : {&fixed_, &mobile_})
      for (const NamedMesh& named : meshes->all())
        holds &= named.mesh.X_BG.matrix().cwiseAbs().maxCoeff() < largest &&
                 named.mesh.scale.cwiseAbs().maxCoeff() < largest;
    if (!holds)
      throw FileError(fmt::format("{}: line {}: joint {}: its numbers are beyond {:g} m, or make such",
                                  model_.path.string(), joint_.line, in_quotes(joint_.name), largest));
  }

  void write_head() {
    add(fmt::format("# Proposed by condyle init {} from joint {} of {}, a model of OpenSim (version {}).",
                    version, joint_.name, core::one_line(path_of(model_.path)), model_.version));
    add("# Lengths are metres and frames are those of the model's bodies. OpenSim's meshes have polygons: "
        "they are split.");
    add(fmt::format("condyle = {}", format_version));
    add("name = " +
        toml_text(fmt::format("{} of {}", joint_.name, model_.name.empty() ? "a model" : model_.name)));
    add(fmt::format("kind = \"{}\"  # {}", name_of(mapping_.kind), mapping_.why));
    const bool is_hinge_of_none = mapping_.kind == JointKind::hinge &&
                                  (!anatomy_ || anatomy_ == Anatomy::hip || anatomy_ == Anatomy::shoulder);
    if (!is_hinge_of_none)
      add(fmt::format("joint = \"{}\"  # {}", name_of(*anatomy_),
                      request_.anatomy ? "given" : "by the names of the joint and its bodies"));
    add(fmt::format("side = \"{}\"  # {}", name_of(side_),
                    request_.side ? "given" : "by the ending of its name"));
    add("units = \"m\"");
    if (!mapping_.oblique.empty()) note(ModelNoteCode::oblique_axis, mapping_.oblique);
    if (!mapping_.turned.empty())
      note(ModelNoteCode::turned_frame,
           mapping_.turned + (mapping_.meanings.empty() ? "" : "; " + meanings()));
    note_given_otherwise();
  }

  std::string meanings() const { return fmt::format("{}", fmt::join(mapping_.meanings, ", ")); }

  void note_given_otherwise() {
    const auto by_names = io::side_of(joint_);
    if (by_names && *by_names != side_)
      note(ModelNoteCode::given_otherwise,
           fmt::format("the side is given as {}, and by its names joint {} is a {} one", name_of(side_),
                       in_quotes(joint_.name), name_of(*by_names)));
    const auto named = io::anatomy_of(joint_);
    if (anatomy_ && named && *named != *anatomy_)
      note(ModelNoteCode::given_otherwise,
           fmt::format("the joint is given as {}, and by its names joint {} is of kind {}",
                       name_of(*anatomy_), in_quotes(joint_.name), name_of(*named)));
  }

  void write_mesh(const NamedMesh& named, bool has_name) {
    if (has_name) add("name = " + toml_text(named.name));
    add("mesh = " + toml_text(named.mesh.path ? path_of(*named.mesh.path) : named.mesh.file));
    if (!io::lower_case(named.mesh.file).ends_with(".stl") && request_.polygons != PolygonRule::refuse)
      add(fmt::format("polygons = \"{}\"", io::name_of(request_.polygons)));
    if (named.mesh.scale != Vec3::Ones()) add("scale = " + toml_numbers(named.mesh.scale));
    if (!named.mesh.X_BG.matrix().isIdentity(0)) add("pose = " + toml_pose(named.mesh.X_BG));
    if (named.mesh.scale.prod() < 0)
      note(ModelNoteCode::mirrored,
           fmt::format("mesh {} is mirrored by its scale factors: its triangles are turned round",
                       in_quotes(named.mesh.file)));
    const Vec3 size = named.mesh.scale.cwiseAbs();
    if (size.maxCoeff() > most_uneven_scale * size.minCoeff())
      note(ModelNoteCode::uneven_scale, fmt::format("mesh {} is scaled by {:.4g}, {:.4g} and {:.4g} along "
                                                    "its axes, which no bone of another size is",
                                                    in_quotes(named.mesh.file), named.mesh.scale.x(),
                                                    named.mesh.scale.y(), named.mesh.scale.z()));
  }

  void write_body(std::string_view role, const std::string& name, const std::vector<NamedMesh>& meshes,
                  const std::optional<Pose>& pose) {
    add(fmt::format("\n[{}]", role));
    add("name = " + toml_text(name));
    if (pose && !pose->matrix().isIdentity(0))
      add("pose = " + toml_pose(*pose) + "  # in the fixed body's frame, all coordinates 0");
    const bool has_names =
        meshes.size() > 1 || (meshes.size() == 1 && !meshes[0].mesh.X_BG.matrix().isIdentity(0));
    for (const NamedMesh& mesh : meshes) {
      if (has_names) add(fmt::format("\n[[{}.meshes]]", role));
      write_mesh(mesh, has_names);
      // With bone beside the cartilage of the mobile body, bone ends motions.
      if (has_names && mobile_.all().size() > 1 &&
          mesh.name == (role == "fixed" ? fixed_part_ : mobile_part_))
        add("contact = \"bearing\"");
    }
    if (meshes.empty()) {
      add("# mesh = \"...\"  # to fill in: the model attaches none to this body");
      out_.proposal.to_fill_in.push_back(
          fmt::format("{}.mesh: the model attaches none to body {}", role, in_quotes(name)));
    } else if (!meshes[0].mesh.path) {
      out_.missing_body += out_.missing_body.empty() ? model_.path.string() + ": " : "; ";
      out_.missing_body += missing(name, meshes);
    }
  }

  static std::string missing(const std::string& body, const std::vector<NamedMesh>& meshes) {
    std::vector<std::string> places;
    for (const NamedMesh& named : meshes)
      for (const fs::path& place : named.mesh.looked_in) places.push_back(place.string());
    return fmt::format("no mesh of body {} was found; looked for {}", in_quotes(body),
                       some_of(std::move(places)));
  }

  void write_frame() {
    const Eigen::Matrix3d R = mapping_.X_WF.linear();
    add("\n[frame]  # in the fixed body's frame");
    add("centre = " + toml_numbers(mapping_.X_WF.translation()));
    add("anterior = " + toml_numbers(R.col(0)));
    add("superior = " + toml_numbers(R.col(1)));
  }

  /// Where functions are not 0 at coordinates of 0.
  void write_reference_pose() {
    std::string keys;
    for (const ColumnOfCoordinate& column : mapping_.columns) {
      if (column.offset == 0) continue;
      const bool is_angle = column.kind == CoordinateKind::angle;
      keys += fmt::format("{} = {}\n", column.coordinate, is_angle ? column.offset : column.offset / 1000);
    }
    if (!keys.empty()) add("\n[reference_pose]\n" + keys);
  }

  void write_recorded_motion() {
    add("\n[recorded_motion]");
    if (!mapping_.meanings.empty()) add("# " + meanings());
    for (const ModelCoordinate& coordinate : joint_.coordinates)
      if (coordinate.stop) add(fmt::format("# {}{}", coordinate.name, stop_text(coordinate, ": ", "")));
    if (mapping_.columns.empty()) {
      add("model = " + toml_text(path_of(model_.path)) + "  # poses the joint by its functions");
      add("joint = " + toml_text(joint_.name));
      return;
    }
    for (const ColumnOfCoordinate& column : mapping_.columns) {
      std::string line = fmt::format("{} = {{ column = {}", column.coordinate, toml_text(column.column));
      if (column.kind == CoordinateKind::length) line += ", unit = \"m\"";
      if (column.sign != 1) line += ", sign = -1";
      if (column.offset != 0) line += fmt::format(", offset = {}", column.offset);
      line += fmt::format(", default = {}", *column.otherwise);
      if (column.range)
        line += fmt::format(", range = [{}, {}]", column.range->front(), column.range->back());
      if (column.is_locked) line += ", locked = true";
      add(line + " }");
    }
    text_ += zero_text({.system = {anatomy_.value_or(Anatomy::hip), side_},
                        .X_PZ = mapping_.X_WF,
                        .X_PC = pose_of(joint_, std::vector<double>(joint_.coordinates.size()))},
                       1);
  }

  // The contact that the model has between the two bodies.

  const ModelContactMesh* find_contact_mesh(const std::string& name) const {
    const auto found = contact_meshes_.find(name);
    return found == contact_meshes_.end() ? nullptr : found->second.front();
  }

  /// Contacts name their meshes: two of one name on a body of this joint leave open which is meant.
  void refuse_second_contact_meshes() const {
    std::set<std::string_view> used;
    for (const ModelContact& contact : model_.contacts) used.insert({contact.casting, contact.target});
    for (const auto& [name, meshes] : contact_meshes_) {
      if (meshes.size() == 1 || !used.contains(name)) continue;
      const auto on_a_body = [&](const ModelContactMesh* mesh) { return role_of(*mesh).has_value(); };
      const auto second = on_a_body(meshes.front())
                              ? meshes.begin() + 1
                              : std::find_if(meshes.begin() + 1, meshes.end(), on_a_body);
      if (second != meshes.end())
        throw FileError(fmt::format("{}: line {}: contact mesh {} is given twice", model_.path.string(),
                                    (*second)->mesh.line, in_quotes(name)));
    }
  }

  const ModelContactMesh& contact_mesh(const std::string& name) const { return *find_contact_mesh(name); }

  /// The role of the body that a contact mesh is attached to, and where it lies there.
  std::optional<std::pair<BodyRole, Pose>> role_of(const ModelContactMesh& mesh) const {
    const auto found = role_of_body_.find(mesh.mesh.body);
    if (found == role_of_body_.end()) return std::nullopt;
    return std::pair(found->second.first, Pose(found->second.second * mesh.mesh.X_BG));
  }

  void choose_contact() {
    refuse_second_contact_meshes();
    std::vector<std::string> names, others;
    for (const ModelContact& contact : model_.contacts) {
      const ModelContactMesh *of_casting = find_contact_mesh(contact.casting),
                             *of_target = find_contact_mesh(contact.target);
      if (!of_casting || !of_target) {
        note(ModelNoteCode::contact_left_out,
             fmt::format("contact {} is left out: there is no contact mesh {}", in_quotes(contact.name),
                         in_quotes(of_casting ? contact.target : contact.casting)));
        continue;
      }
      const auto casting = role_of(*of_casting), target = role_of(*of_target);
      if (!casting || !target || casting->first == target->first) continue;
      names.push_back(contact.name);
      if (!request_.contact.empty() && contact.name != request_.contact) continue;
      if (!contact.applies) {
        note(ModelNoteCode::contact_left_out,
             fmt::format("contact {} is not applied in the model, and left out", in_quotes(contact.name)));
        continue;
      }
      if (contact_) {
        others.push_back(contact.name);
        continue;
      }
      contact_ = &contact;
    }
    if (!request_.contact.empty() && !contact_)
      throw UsageError(fmt::format("{}: joint {}: no contact {}{}; there are {}", model_.path.string(),
                                   in_quotes(joint_.name), in_quotes(request_.contact),
                                   core::did_you_mean(request_.contact, names),
                                   names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
    if (!others.empty())
      note(ModelNoteCode::several_contacts,
           fmt::format("of the contacts between these bodies {} is taken, and {} left out",
                       in_quotes(contact_->name), fmt::join(others, ", ")));
    if (contact_) attach_contact();
  }

  /// Makes sure that both surfaces are among the meshes of their bodies.
  void attach_contact() {
    for (const std::string* name : {&contact_->casting, &contact_->target}) {
      const ModelContactMesh& mesh = contact_mesh(*name);
      if (mesh.mesh.path) continue;
      note(ModelNoteCode::contact_left_out,
           fmt::format("contact {} is left out: mesh {} of {} is missing", in_quotes(contact_->name),
                       in_quotes(mesh.mesh.file), in_quotes(*name)));
      contact_ = nullptr;
      return;
    }
    for (const std::string* name : {&contact_->casting, &contact_->target}) {
      const ModelContactMesh& mesh = contact_mesh(*name);
      const auto [role, X] = *role_of(mesh);
      ModelMesh placed = mesh.mesh;
      placed.X_BG = X;
      BodyMeshes& meshes = meshes_of_role(role);
      const NamedMesh* same = meshes.find(placed);
      const std::string part = same ? same->name : add_mesh(meshes, placed, *name).name;
      (role == BodyRole::fixed ? fixed_part_ : mobile_part_) = part;
    }
  }

  void write_contact() {
    if (!contact_) return;
    const ModelContactMesh& casting = contact_mesh(contact_->casting);
    const ModelContactMesh& target = contact_mesh(contact_->target);
    const auto [casting_role, X_casting] = *role_of(casting);
    add(contact_lines(
        model_,
        {*contact_,
         {casting, X_casting},
         {target, role_of(target)->second},
         casting_role,
         fixed_.all().size() > 1 ? fixed_part_ : "",
         mobile_.all().size() > 1 ? mobile_part_ : ""},
        [&](const fs::path& file) { return path_of(file); }, out_.notes));
  }

  void note_what_is_left_out() {
    std::vector<std::string> kinds;
    for (const auto& [kind, count] : model_.ignored) kinds.push_back(fmt::format("{} {}", count, kind));
    if (!kinds.empty())
      note(ModelNoteCode::not_used, fmt::format("not used here: {}", fmt::join(kinds, ", ")));
    for (const BodyRole role : {BodyRole::fixed, BodyRole::mobile}) {
      std::vector<std::string> names;
      for (const WeldedBody& body : bodies_of_role(role)) names.push_back(body.name);
      if (names.size() > 1) note(ModelNoteCode::welded, "welded to one body: " + some_of(names));
    }
    out_.notes.insert(out_.notes.end(), model_.notes.begin(), model_.notes.end());
    if (has_proximal_child(joint_))
      note(ModelNoteCode::exchanged_bodies,
           fmt::format("the child body, {}, is the proximal bone: angles are of it in {}, so a flexion of "
                       "the joint is negative here, and so on",
                       in_quotes(joint_.child_body), in_quotes(joint_.parent_body)));
    // New coordinates of OpenSim have ends of 10 rad, and those without limits ends of 99999.9.
    constexpr double most_turned = 4 * std::numbers::pi, most_degrees = 720;
    for (const ModelCoordinate& coordinate : joint_.coordinates) {
      if (coordinate.motion != CoordinateMotion::rotational || !coordinate.range) continue;
      const auto& [low, high] = *coordinate.range;
      if (const double most = std::max(-low, high); most > most_turned && most <= most_degrees)
        note(ModelNoteCode::unlikely_range,
             fmt::format("coordinate {} has a range from {:g} to {:g} rad, over two turns: is it in degrees?",
                         in_quotes(coordinate.name), low, high));
    }
    if (const ModelCoupler* coupler = coupler_of_joint())
      note(ModelNoteCode::coupled_coordinate,
           fmt::format("coordinate {} follows {} by constraint {}, where a motion has no column of it",
                       in_quotes(coupler->dependent), fmt::join(coupler->independent, ", "),
                       in_quotes(coupler->name)));
  }

  const Model& model_;
  const ModelJointRequest& request_;
  const ModelJoint& joint_;
  std::optional<Anatomy> anatomy_;
  Side side_ = Side::right;
  JointMapping mapping_{.kind = JointKind::free};
  std::vector<WeldedBody> fixed_bodies_, mobile_bodies_;
  BodyMeshes fixed_, mobile_;
  /// By the body's name: which role it has and where it lies in that one. The fixed body's first.
  RoleOfBody role_of_body_;
  std::map<std::string_view, std::vector<const ModelContactMesh*>> contact_meshes_;
  const ModelContact* contact_ = nullptr;
  std::string fixed_part_, mobile_part_;
  std::string text_;
  ModelJointProposal out_;
};

}  // namespace
ModelJointProposal propose_joint(const Model& model, const ModelJointRequest& request) {
  ModelJointProposal proposed = ModelJointFile(model, request).proposal();
  if (!proposed.missing_body.empty() || !proposed.proposal.to_fill_in.empty()) return proposed;
  const fs::path path = request.joint_file.empty() ? fs::path("joint.toml") : request.joint_file;
  try {
    io::load_joint(io::joint_file_of(proposed.proposal.toml, path));
  } catch (const std::runtime_error& error) {  // FileError or MeshError
    proposed.unreadable = error.what();
  }
  return proposed;
}

JointFileOfModel joint_file_of(const Model& model, ModelJointRequest request) {
  request.joint_file = model.path;
  ModelJointProposal proposed = ModelJointFile(model, request).proposal();
  if (!proposed.missing_body.empty()) throw FileError(proposed.missing_body);
  if (!proposed.proposal.to_fill_in.empty())
    throw FileError(fmt::format("{}: {}", model.path.string(), proposed.proposal.to_fill_in.front()));
  JointFile file = joint_file_of(proposed.proposal.toml, model.path);
  file.digest = model.digest;
  std::vector<std::string> processing;
  for (const ModelNote& note : proposed.notes) processing.push_back(to_text(note));
  file.processing.insert(file.processing.begin(), processing.begin(), processing.end());
  return {std::move(file), std::move(proposed.notes)};
}

LoadedJoint read_joint(const Model& model, const ModelJointRequest& request) {
  return io::load_joint(io::joint_file_of(model, request).file);
}

}  // namespace condyle::io
