#include "io/model/model_contact_lines.hpp"

#include <fmt/format.h>

#include "condyle/error.hpp"
#include "io/file/in_quotes.hpp"
#include "io/joint/proposal_lines.hpp"

namespace condyle::io {
namespace {

class ContactLines {
 public:
  ContactLines(const Model& model, const ChosenContact& chosen,
               const std::function<std::string(const std::filesystem::path&)>& path_of,
               std::vector<ModelNote>& notes)
      : model_(model), chosen_(chosen), path_of_(path_of), notes_(notes) {}

  std::string text() {
    check();
    const ModelContact& contact = chosen_.contact;
    const bool is_mobile = chosen_.casting_role == BodyRole::mobile;
    add(fmt::format("\n[contact]  # {} of the model", in_quotes(contact.name)));
    add(fmt::format("casting = \"{}\"", is_mobile ? "mobile" : "fixed"));
    add("rule = \"face_centre\"  # a ray from each triangle's centre, as OpenSim-JAM casts them");
    add(fmt::format("reach = {}", contact.greatest_proximity));
    add(fmt::format("law = \"{}\"", contact.is_linear ? "linear" : "logarithmic"));
    add("moment_on = \"target\"  # as OpenSim-JAM prints it; the force is on the casting body");
    if (!chosen_.fixed_part.empty()) add("fixed_part = " + toml_text(chosen_.fixed_part));
    if (!chosen_.mobile_part.empty()) add("mobile_part = " + toml_text(chosen_.mobile_part));
    const PlacedContactMesh &casting = chosen_.casting, &target = chosen_.target;
    add_layer("fixed", is_mobile ? target : casting, is_mobile ? casting.mesh : target.mesh);
    add_layer("mobile", is_mobile ? casting : target, is_mobile ? target.mesh : casting.mesh);
    text_.pop_back();  // the caller ends the last line
    return std::move(text_);
  }

 private:
  void add(const std::string& line) { text_ += line + "\n"; }

  [[noreturn]] void refuse(const std::string& what) const {
    throw FileError(fmt::format("{}: line {}: contact {}: {}", model_.path.string(), chosen_.contact.line,
                                in_quotes(chosen_.contact.name), what));
  }

  void check() const {
    const ModelContact& contact = chosen_.contact;
    if (contact.least_proximity != 0)
      refuse(fmt::format("min_proximity {} is not 0", contact.least_proximity));
    if (!(contact.greatest_proximity > 0))
      refuse(fmt::format("max_proximity {} is not above 0", contact.greatest_proximity));
    for (const ModelContactMesh* mesh : {&chosen_.casting.mesh, &chosen_.target.mesh}) check(*mesh);
  }

  void check(const ModelContactMesh& mesh) const {
    if (!(mesh.youngs_modulus_pa > 0))
      refuse(fmt::format("elastic_modulus of {} must be above 0", in_quotes(mesh.name)));
    if (!(mesh.poisson_ratio < 0.5 && mesh.poisson_ratio > -1))
      refuse(
          fmt::format("poissons_ratio {} of {} is not below 0.5", mesh.poisson_ratio, in_quotes(mesh.name)));
    if (!mesh.has_variable_thickness && !(mesh.thickness > 0))
      refuse(fmt::format("thickness of {} must be above 0", in_quotes(mesh.name)));
    if (mesh.has_variable_thickness &&
        !(mesh.least_thickness > 0 && mesh.least_thickness <= mesh.greatest_thickness))
      refuse(fmt::format("min_thickness {} of {} must be above 0 and at most max_thickness, {}",
                         mesh.least_thickness, in_quotes(mesh.name), mesh.greatest_thickness));
  }

  void add_layer(std::string_view role, const PlacedContactMesh& placed, const ModelContactMesh& other) {
    const ModelContactMesh& mesh = placed.mesh;
    double modulus = mesh.youngs_modulus_pa, ratio = mesh.poisson_ratio;
    const bool is_mean =
        chosen_.contact.is_lumped && (other.youngs_modulus_pa != modulus || other.poisson_ratio != ratio);
    if (is_mean) {
      modulus = (modulus + other.youngs_modulus_pa) / 2;
      ratio = (ratio + other.poisson_ratio) / 2;
    }
    add(fmt::format("\n[contact.{}]{}", role,
                    is_mean ? "  # the means of both: the model's contact is lumped" : ""));
    add(fmt::format("youngs_modulus_mpa = {}", modulus / 1e6));
    add(fmt::format("poisson_ratio = {}", ratio));
    if (mesh.has_variable_thickness)
      add_measured(placed);
    else
      add(fmt::format("thickness = {}", mesh.thickness));
  }

  void add_measured(const PlacedContactMesh& placed) {
    const ModelContactMesh& mesh = placed.mesh;
    if (!mesh.back_path)
      refuse(
          fmt::format("mesh_back_file {} of {} is missing", in_quotes(mesh.back_file), in_quotes(mesh.name)));
    if (mesh.mesh.scale != Vec3::Ones() || !placed.X.matrix().isIdentity(0))
      refuse(fmt::format("the thickness of {} varies, and its mesh is scaled or moved in its body",
                         in_quotes(mesh.name)));
    add("behind = " + toml_text(path_of_(*mesh.back_path)));
    add(fmt::format("thickness = {}  # of vertices with nothing behind them", mesh.least_thickness));
    add(fmt::format(
        "thickness_bounds = [{}, {}]  # OpenSim-JAM takes the least beyond them; here they are noted",
        mesh.least_thickness, mesh.greatest_thickness));
    notes_.push_back(
        {ModelNoteCode::measured_thickness,
         fmt::format(
             "the thickness of {} is measured at its vertices and used as it is; OpenSim-JAM measures it at "
             "triangles and takes {} m where it is not {} to {} m: pressures are near to its own, not equal",
             in_quotes(mesh.name), mesh.least_thickness, mesh.least_thickness, mesh.greatest_thickness)});
  }

  const Model& model_;
  const ChosenContact& chosen_;
  const std::function<std::string(const std::filesystem::path&)>& path_of_;
  std::vector<ModelNote>& notes_;
  std::string text_;
};

}  // namespace

std::string contact_lines(const Model& model, const ChosenContact& chosen,
                          const std::function<std::string(const std::filesystem::path&)>& path_of,
                          std::vector<ModelNote>& notes) {
  return ContactLines(model, chosen, path_of, notes).text();
}

}  // namespace condyle::io
