#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <set>

#include "condyle/error.hpp"
#include "condyle/io/model_file.hpp"
#include "core/one_line.hpp"
#include "io/file/in_quotes.hpp"
#include "io/file/plain_text.hpp"
#include "io/file/whole_file.hpp"
#include "io/file/words.hpp"
#include "io/model/find_mesh.hpp"
#include "io/model/model_frames.hpp"
#include "io/model/model_limits.hpp"
#include "io/model/read_joint.hpp"
#include "io/model/read_ligament.hpp"
#include "io/model/spatial_transform.hpp"

namespace condyle::io {
namespace {

constexpr int first_version = 10500, last_version = 40600;
constexpr std::size_t largest_file = 100'000'000;

/// Goes through a model twice: bodies and frames first, then what refers to them.
class ModelReader {
 public:
  ModelReader(const Source& source, Model& model, std::span<const std::filesystem::path> folders)
      : source_(source), model_(model), folders_(folders), frames_(source) {
    folder_ = model.path.parent_path();
    if (folder_.empty()) folder_ = ".";
  }

  void read(const XmlElement& root) {
    const XmlElement& model = *root.child("Model");
    frames_.add_body("ground");
    collect_frames(model, "");
    read_components(model, "");
    for (const std::string& body : frames_.bodies()) model_.bodies.push_back(plain_text(body));
    for (const auto& [kind, count] : shapes_) model_.ignored[kind] += count;
    count_unused_wraps();
    refuse_couplers_of_one_coordinate();
    refuse_joints_of_one_name();
    add_stops();
  }

 private:
  static bool is_body(const XmlElement& element) {
    return element.name == "Body" || element.name == "Ground";
  }

  static std::string name_of_body(const XmlElement& element) {
    return element.name == "Ground" ? "ground" : element.label();
  }

  static bool is_list(std::string_view name) { return name == "objects" || name == "components"; }

  static bool is_container(std::string_view name) {
    return is_list(name) || name == "frames" || name == "Joint" ||
           (name.ends_with("Set") && name != "CoordinateSet" && name != "WrapObjectSet" &&
            name != "GeometrySet" && name != "PathPointSet");
  }

  static bool is_stop(std::string_view name) {
    return name == "CoordinateLimitForce" || name == "CoordinateLinearStopForce";
  }

  static bool is_frame(const XmlElement& element) { return element.name.ends_with("Frame"); }

  static std::string path_in(const std::string& owner, const XmlElement& frame) {
    return owner + "/" + frame.label();
  }

  /// Bodies, and frames wherever they stand, with what they stand in.
  void collect_frames(const XmlElement& element, const std::string& owner) {
    for (const XmlElement& child : element.children) {
      if (is_body(child)) {
        const std::string name = name_of_body(child);
        if (name.empty())
          model_.notes.push_back({ModelNoteCode::no_name,
                                  fmt::format("line {}: a body has no name and is left out", child.line)});
        if (name != "ground" && !name.empty()) frames_.add_body(name);
        if (!name.empty()) collect_frames(child, name);
      } else if (is_frame(child)) {
        frames_.add_frame(child, owner);
        collect_frames(child, path_in(owner, child));
      } else if (child.name == "Station" || child.name == "Marker") {
        frames_.add_point(child, owner);
      } else if (is_joint(child.name)) {
        collect_frames(child, place_of_joint(child));
      } else if (is_container(child.name)) {
        collect_frames(child, owner);
      }
    }
  }

  /// Reads a component. One that cannot be read is left out with a note, for the joints do not need it.
  template <class Read>
  void or_leave_out(const Read& read) {
    try {
      read();
    } catch (const FileError& error) {
      const std::string_view line = error.what();
      model_.notes.push_back({ModelNoteCode::left_out,
                              std::string(line.substr(source_.name.size() + std::string_view(": ").size()))});
    }
  }

  void note_nameless(const ModelJoint& joint) {
    if (joint.name.empty())
      model_.notes.push_back(
          {ModelNoteCode::no_name,
           fmt::format("line {}: a {} of {} has no name, and nobody can ask for it", joint.line, joint.type,
                       joint.child_body.empty() ? "no body" : in_quotes(joint.child_body))});
  }

  void note_reverse(const ModelJoint& joint) {
    if (joint.is_reversed && model_.version > last_version_with_reverse)
      model_.notes.push_back(
          {ModelNoteCode::reverse_passed_over,
           fmt::format("joint {}: reverse is not of version {}, and is passed over as OpenSim does",
                       in_quotes(joint.name), model_.version)});
  }

  void read_components(const XmlElement& element, const std::string& owner) {
    for (const XmlElement& child : element.children) {
      const std::string_view name = child.name;
      if (is_body(child)) {
        if (const std::string body = name_of_body(child); !body.empty()) read_body(child, body);
      } else if (is_frame(child)) {
        read_geometry(child, path_in(owner, child));
        read_components(child, path_in(owner, child));
      } else if (is_joint(name)) {
        model_.joints.push_back(joint_of(source_, child, owner, frames_, model_.version));
        note_reverse(model_.joints.back());
        note_nameless(model_.joints.back());
        read_components(child, place_of_joint(child));
      } else if (name == "Mesh" && owner.empty()) {
        or_leave_out([&] { read_mesh_element(child, ""); });
      } else if (name == "CoordinateCouplerConstraint") {
        or_leave_out([&] { read_coupler(child); });
      } else if (is_stop(name)) {
        or_leave_out([&] { read_stop(child); });
        ++model_.ignored[std::string(name)];  // it places no bone
      } else if (name == "Smith2018ContactMesh") {
        or_leave_out([&] { read_contact_mesh(child); });
      } else if (name == "Smith2018ArticularContactForce") {
        or_leave_out([&] { read_contact(child); });
      } else if (name == "Blankevoort1991Ligament") {
        or_leave_out([&] { model_.ligaments.push_back(ligament_of(source_, child, frames_)); });
      } else if (is_container(name)) {
        read_components(child, owner);
      } else if (is_list(element.name) && name != "Mesh" && name != "FrameGeometry" && name != "Station") {
        ++model_.ignored[core::one_line(name, 60)];  // muscles, ligaments, controllers, markers
      }
    }
  }

  void read_body(const XmlElement& body, const std::string& name) {
    read_geometry(body, name);
    try {
      read_visible_object(body, name);
    } catch (const FileError& error) {
      add_unreadable_mesh(body, name, error);
    }
    if (const XmlElement* wraps = body.at({"WrapObjectSet", "objects"}))
      for (const XmlElement& wrap : wraps->children) model_.wraps.push_back(wrap_of(source_, wrap, name));
    read_components(body, name);
  }

  /// Meshes of 4.x: in the frame that they stand in, or that their socket names.
  void read_geometry(const XmlElement& frame, const std::string& path) {
    for (const std::string_view place : {"attached_geometry", "components"}) {
      const XmlElement* geometry = frame.child(place);
      if (!geometry) continue;
      for (const XmlElement& shape : geometry->children) {
        if (shape.name == "Mesh") {
          or_leave_out([&] { read_mesh_element(shape, path); });
        } else if (place == "attached_geometry" && shape.name != "FrameGeometry") {
          ++shapes_[core::one_line(shape.name, 60)];
        }
      }
    }
  }

  void read_mesh_element(const XmlElement& element, const std::string& owner) {
    const ModelElement values(source_, element, fmt::format("mesh {}", in_quotes(element.label())));
    ModelMesh mesh{.line = element.line};
    std::string socket = values.text("socket_frame");
    if (socket.empty()) socket = values.text("socket_frame_connectee_name");
    const bool stands_here = socket.empty() || socket == "..";
    if (stands_here && owner.empty()) {
      ++model_.ignored["Mesh of no frame"];
      return;
    }
    try {
      const BodyPlace place =
          stands_here ? frames_.place_at(owner, values) : frames_.place_of(socket, owner, values);
      mesh.body = place.body;
      mesh.X_BG = place.X;
      mesh.scale = values.triple({"scale_factors"}, Vec3::Ones());
      add_mesh(std::move(mesh), values.text("mesh_file"), values);
    } catch (const FileError& error) {
      const std::string body = mesh.body.empty() ? owner.substr(0, owner.find('/')) : mesh.body;
      if (!frames_.is_body(body)) throw;
      add_unreadable_mesh(element, body, error);
    }
  }

  /// Joints of this body are refused for it, others are not.
  void add_unreadable_mesh(const XmlElement& element, const std::string& body, const FileError& error) {
    model_.meshes.push_back({.body = body, .line = element.line, .why_not = error.what()});
  }

  /// Meshes before 3.2: each in the frame of its shape in that of the body's shapes.
  void read_visible_object(const XmlElement& body, const std::string& name) {
    const XmlElement* visible = body.child("VisibleObject");
    if (!visible) return;
    const ModelElement outer(source_, *visible, fmt::format("body {}", in_quotes(name)));
    const Vec3 outer_scale = outer.triple({"scale_factors"}, Vec3::Ones());
    if (const XmlElement* files = visible->child("geometry_files")) {
      const std::string names = files->text();
      for (const std::string_view file : io::words_of(names))
        add_mesh({.body = name, .scale = outer_scale, .line = files->line}, std::string(file), outer);
    }
    const XmlElement* shapes = visible->at({"GeometrySet", "objects"});
    if (!shapes) return;
    const Pose X_outer = transform_in(outer);
    for (const XmlElement& shape : shapes->children) {
      if (shape.name != "DisplayGeometry") {
        ++shapes_[core::one_line(shape.name, 60)];
        continue;
      }
      const ModelElement inner(source_, shape, fmt::format("body {}", in_quotes(name)));
      const Vec3 scale = outer_scale.cwiseProduct(inner.triple({"scale_factors"}, Vec3::Ones()));
      add_mesh({.body = name, .scale = scale, .X_BG = X_outer * transform_in(inner), .line = shape.line},
               inner.text("geometry_file"), inner);
    }
  }

  /// <transform>: three body-fixed X-Y-Z angles, then three lengths.
  static Pose transform_in(const ModelElement& element) {
    Pose X = Pose::Identity();
    const XmlElement* transform = element.xml().child("transform");
    if (!transform || transform->text().empty()) return X;
    const std::vector<double> values = element.numbers(*transform);
    if (values.size() != 6)
      element.fail_at(*transform, fmt::format("transform: six numbers are needed, not {}", values.size()));
    X.linear() = body_fixed_xyz({values[0], values[1], values[2]});
    X.translation() = Vec3(values[3], values[4], values[5]);
    return X;
  }

  MeshLocation found_mesh(const std::string& file) {
    MeshLocation found = find_mesh(file, folder_, folders_);
    if (found.in_another_case) {
      const std::string own = found.path->filename().string();
      const bool differs = own != std::filesystem::path(file).filename();  // else a folder does
      model_.notes.push_back({ModelNoteCode::other_case,
                              fmt::format("mesh {} was found as {}", in_quotes(file),
                                          differs ? in_quotes(own) : plain_text(found.path->string()))});
    }
    return found;
  }

  void add_mesh(ModelMesh mesh, std::string file, const ModelElement& of) {
    if (file.empty()) return;
    of.require_plain(file, "the name of its file");
    mesh.file = std::move(file);
    MeshLocation found = found_mesh(mesh.file);
    mesh.path = std::move(found.path);
    mesh.looked_in = std::move(found.looked_in);
    model_.meshes.push_back(std::move(mesh));
  }

  void read_contact_mesh(const XmlElement& element) {
    const ModelElement values(source_, element, fmt::format("contact mesh {}", in_quotes(element.label())));
    const std::string name = values.name();
    std::string socket = values.text("socket_frame");
    if (socket.empty()) values.fail("socket_frame is missing");
    const BodyPlace place = frames_.place_of(socket, "", values);
    ModelContactMesh contact{.name = name, .mesh = {.line = element.line}};
    contact.mesh.body = place.body;
    contact.mesh.X_BG = place.X * offset_of(values, {"location"}, {"orientation"});
    contact.mesh.scale = values.triple({"scale_factors"}, Vec3::Ones());
    contact.mesh.file = values.text("mesh_file");
    if (contact.mesh.file.empty()) values.fail("mesh_file is missing");
    MeshLocation found = found_mesh(contact.mesh.file);
    contact.mesh.path = std::move(found.path);
    contact.mesh.looked_in = std::move(found.looked_in);
    contact.youngs_modulus_pa = values.number("elastic_modulus", 1e6);
    contact.poisson_ratio = values.number("poissons_ratio", 0.5);
    contact.thickness = values.number("thickness", 0.005);
    contact.has_variable_thickness = values.flag("use_variable_thickness", false);
    contact.back_file = values.text("mesh_back_file");
    if (!contact.back_file.empty()) contact.back_path = found_mesh(contact.back_file).path;
    contact.least_thickness = values.number("min_thickness", 0.001);
    contact.greatest_thickness = values.number("max_thickness", 0.01);
    model_.contact_meshes.push_back(std::move(contact));
  }

  void read_contact(const XmlElement& element) {
    const ModelElement values(source_, element, fmt::format("contact {}", in_quotes(element.label())));
    ModelContact contact{.name = values.name(), .line = element.line};
    const auto mesh = [&](const char* key) {
      const std::string socket = values.text(key);
      if (socket.empty()) values.fail(fmt::format("{} is missing", key));
      return last_of_path(socket);
    };
    contact.casting = mesh("socket_casting_mesh");
    contact.target = mesh("socket_target_mesh");
    contact.least_proximity = values.number("min_proximity", 0);
    contact.greatest_proximity = values.number("max_proximity", 0.01);
    const std::string formulation = values.text("elastic_foundation_formulation");
    if (!formulation.empty() && formulation != "linear" && formulation != "nonlinear")
      values.fail(fmt::format("elastic_foundation_formulation {} is not read", in_quotes(formulation)));
    contact.is_linear = formulation != "nonlinear";
    contact.is_lumped = values.flag("use_lumped_contact_model", true);
    contact.applies = values.flag("appliesForce", true);
    model_.contacts.push_back(std::move(contact));
  }

  /// A force that begins to act where a coordinate leaves these ends.
  struct Stop {
    std::string name, coordinate;
    std::array<double, 2> ends;
    bool has_degrees;  ///< of a rotational coordinate
  };

  void read_stop(const XmlElement& element) {
    const ModelElement values(source_, element, fmt::format("force {}", in_quotes(element.label())));
    if (!values.flag("appliesForce", true) || values.flag("isDisabled", false)) return;
    stops_.push_back({std::string(element.label()),
                      last_of_path(values.text("coordinate")),
                      {values.number("lower_limit", 0), values.number("upper_limit", 0)},
                      element.name == "CoordinateLimitForce"});
  }

  void add_stops() {
    for (ModelJoint& joint : model_.joints)
      for (ModelCoordinate& coordinate : joint.coordinates)
        for (const Stop& stop : stops_) {
          if (stop.coordinate != coordinate.name) continue;
          const bool in_degrees = stop.has_degrees && coordinate.motion == CoordinateMotion::rotational;
          const double unit = in_degrees ? std::numbers::pi / 180 : 1;
          const double lower = unit * stop.ends[0], upper = unit * stop.ends[1];
          const auto before = coordinate.stop.value_or(std::array{lower, upper});
          coordinate.stop = {std::max(before[0], lower), std::min(before[1], upper)};
          if (!is_own_force(stop.name, coordinate.name))
            coordinate.stop_by_others +=
                (coordinate.stop_by_others.empty() ? "" : ", ") + in_quotes(stop.name);
        }
  }

  void read_coupler(const XmlElement& element) {
    const ModelElement values(source_, element, fmt::format("constraint {}", in_quotes(element.label())));
    ModelCoupler coupler{.name = values.name()};
    if (!values.flag("isEnforced", true) || values.flag("isDisabled", false)) {
      ++model_.ignored["CoordinateCouplerConstraint that is not enforced"];
      return;
    }
    coupler.dependent = last_of_path(values.text("dependent_coordinate_name"));
    const XmlElement* list = element.child("independent_coordinate_names");
    const std::string names = list ? list->text() : std::string();
    for (const std::string_view name : io::words_of(names))
      coupler.independent.emplace_back(last_of_path(name));
    if (coupler.dependent.empty()) values.fail("dependent_coordinate_name is missing");
    try {
      const auto function = values.function();
      if (!function) values.fail("its function is missing");
      const std::size_t count = coupler.independent.size();
      if (count == 0 || arguments_of(*function).value_or(count) != count)
        values.fail("its function is of another number of coordinates");
      coupler.function = std::make_shared<const CouplerFunction>(
          CouplerFunction{values.number("scale_factor", 1), *function});
    } catch (const FileError& error) {
      coupler.why_not = error.what();
    }
    model_.couplers.push_back(std::move(coupler));
  }

  /// Names of coordinates may be paths to them.
  static std::string last_of_path(std::string_view name) {
    return std::string(name.substr(name.rfind('/') + 1));
  }

  /// Muscles wrap surfaces too.
  void count_unused_wraps() {
    std::set<std::string_view> used;
    for (const ModelLigament& ligament : model_.ligaments)
      used.insert(ligament.wraps.begin(), ligament.wraps.end());
    for (const ModelWrap& wrap : model_.wraps)
      if (!used.contains(wrap.name)) ++model_.ignored[core::one_line(wrap.type, 60)];
  }

  /// OpenSim holds all of them at once, which a column of poses cannot. Each names the last one, which names the one before it.
  void refuse_couplers_of_one_coordinate() {
    std::map<std::string_view, std::vector<ModelCoupler*>> of_coordinate;
    for (ModelCoupler& coupler : model_.couplers) of_coordinate[coupler.dependent].push_back(&coupler);
    for (const auto& [coordinate, couplers] : of_coordinate) {
      if (couplers.size() == 1) continue;
      for (std::size_t i = 0; i < couplers.size(); ++i) {
        const std::size_t first = std::min(i, couplers.size() - 2);
        couplers[i]->function = nullptr;
        couplers[i]->why_not = fmt::format("{}: constraints {} and {} both give coordinate {}",
                                           model_.path.string(), in_quotes(couplers[first]->name),
                                           in_quotes(couplers.back()->name), in_quotes(coordinate));
      }
    }
  }

  void refuse_joints_of_one_name() {
    std::map<std::string, ModelJoint*> first;
    for (ModelJoint& joint : model_.joints) {
      if (joint.name.empty()) continue;
      const auto [known, is_new] = first.emplace(joint.name, &joint);
      if (is_new) continue;
      for (ModelJoint* each : {known->second, &joint}) {
        each->transform = nullptr;
        each->why_not = fmt::format("{}: line {}: joint {} is given twice", source_.name, joint.line,
                                    in_quotes(joint.name));
      }
    }
  }

  const Source& source_;
  Model& model_;
  std::span<const std::filesystem::path> folders_;
  std::filesystem::path folder_;
  ModelFrames frames_;
  std::vector<Stop> stops_;
  std::map<std::string, std::size_t> shapes_;  ///< spheres, bricks and the like among the meshes
};

void check_folders(std::span<const std::filesystem::path> folders) {
  for (const std::filesystem::path& folder : folders)
    if (entry_at(folder) != EntryKind::folder)
      throw FileError(folder.string() + ": is no folder that meshes can be looked for in");
}

int version_of(const XmlElement& root, const Source& source) {
  const std::string text = root.label();
  int version = 0;
  if (text.empty()) source.fail(fmt::format("line {}: OpenSimDocument: Version is missing", root.line));
  if (!parse_number(text, version))
    source.fail(fmt::format("line {}: OpenSimDocument: Version {} is no number", root.line, in_quotes(text)));
  if (version < first_version)
    source.fail(fmt::format("line {}: version {} is before {}: save the model with OpenSim 3 or later",
                            root.line, version, first_version));
  if (version > last_version)
    source.fail(fmt::format("line {}: version {} is after {}, the last one that is known here", root.line,
                            version, last_version));
  return version;
}

/// OpenSim takes all lengths for metres and never looks here. Where nobody set a unit it writes "Unassigned".
void check_length_units(const XmlElement& of_model, const Source& source, Model& model) {
  const XmlElement* element = of_model.child("length_units");
  const std::string written = element ? element->text() : std::string(), units = lower_case(written);
  for (const char* metres : {"", "m", "meter", "meters", "metre", "metres"})
    if (units == metres) return;
  if (units != "unassigned" && units != "unknown" && units != "unknownunits")
    ModelElement(source, *element)
        .fail(fmt::format("length_units {}: OpenSim takes all lengths for metres", in_quotes(written)));
  model.notes.push_back(
      {ModelNoteCode::no_length_unit,
       fmt::format("length_units is {}: lengths are metres, as OpenSim takes them", in_quotes(written))});
}

}  // namespace
Model read_model(const std::filesystem::path& path, std::span<const std::filesystem::path> geometry_folders) {
  if (io::size_of_file(path) > io::largest_file)
    throw FileError(fmt::format("{}: larger than {} MB", path.string(), io::largest_file / 1'000'000));
  return read_model(io::read_whole_file(path), path, geometry_folders);
}

Model read_model(std::string_view bytes, const std::filesystem::path& path,
                 std::span<const std::filesystem::path> geometry_folders) {
  io::check_folders(geometry_folders);
  const std::string name = path.string();
  Model model{.path = path, .digest = digest_of(bytes)};
  bytes = io::without_byte_order_mark(bytes);
  const Source source{bytes, name};
  if (bytes.substr(0, 2) == "\xff\xfe" || bytes.substr(0, 2) == "\xfe\xff")
    source.fail("line 1: is UTF-16: save it as UTF-8");
  const XmlElement root = io::xml_tree(source);
  if (root.name != "OpenSimDocument")
    source.fail(
        fmt::format("line {}: no OpenSim model: it begins with {}", root.line, io::in_quotes(root.name)));
  model.version = io::version_of(root, source);
  const XmlElement* of_model = root.child("Model");
  if (!of_model) source.fail(fmt::format("line {}: there is no Model in it", root.line));
  model.name = io::plain_text(of_model->label());
  io::check_length_units(*of_model, source, model);
  ModelReader(source, model, geometry_folders).read(root);
  return model;
}

}  // namespace condyle::io
