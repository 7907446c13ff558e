#include "io/model/model_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "io/file/in_quotes.hpp"
#include "io/file/xml_escaped.hpp"
#include "io/mesh/parse.hpp"
#include "io/model/read_joint.hpp"
#include "io/model/xml_tree.hpp"

namespace condyle::io {
namespace {

constexpr double radians = std::numbers::pi / 180;

/// Names of forces are these and the coordinate's.
constexpr std::string_view limit_name = "condyle_limit_", linear_name = "condyle_stop_";

struct Force {
  std::string_view element;
  std::string name;
  std::vector<std::pair<std::string_view, std::string>>
      properties;  ///< and their values, as they stand in XML
};

/// Stiffness, damping and transition are those of a new CoordinateLimitForce: Condyle knows none.
Force force_of(const CoordinateRange& range, StopForce stop) {
  const std::string coordinate = xml_escaped(range.coordinate);
  if (stop == StopForce::linear)
    return {"CoordinateLinearStopForce",
            std::string(linear_name) + range.coordinate,
            {{"coordinate", coordinate},
             {"stiffness", fmt::format("{}", 1 / radians)},
             {"damping", "0"},
             {"upper_limit", fmt::format("{}", range.upper_deg * radians)},
             {"lower_limit", fmt::format("{}", range.lower_deg * radians)}}};
  return {"CoordinateLimitForce",
          std::string(limit_name) + range.coordinate,
          {{"coordinate", coordinate},
           {"upper_stiffness", "1"},
           {"upper_limit", fmt::format("{}", range.upper_deg)},
           {"lower_stiffness", "1"},
           {"lower_limit", fmt::format("{}", range.lower_deg)},
           {"damping", "0.001"},
           {"transition", "0.1"}}};
}

std::string element_text(std::string_view element, std::string_view value) {
  return fmt::format("<{0}>{1}</{0}>", element, value);
}

/// Replaces parts of a text at the places that its tree has in it.
class EditedXml {
 public:
  explicit EditedXml(std::string_view bytes)
      : bytes_(bytes), line_end_(bytes.find("\r\n") == bytes.npos ? "\n" : "\r\n") {}

  /// Puts text behind an element's opening tag, and behind what was put there before. Its lines end as the others do.
  void insert(const XmlElement& element, std::string text) {
    auto& [name, inserted] = inserted_[tag_end(element)];
    name = element.name;
    for (std::size_t at = 0; line_end_.size() == 2 && (at = text.find('\n', at)) != text.npos; at += 2)
      text.insert(at, 1, '\r');
    inserted += text;
  }

  /// Takes away what was inserted behind an element's opening tag before: a comment in lines of its own that has this word.
  void remove_comment(const XmlElement& element, std::string_view word) {
    const std::size_t at = tag_end(element) + 1;
    const std::string begin = line_end_ + "<!--", end = "-->" + line_end_;
    if (!bytes_.substr(at).starts_with(begin)) return;
    const std::size_t last = bytes_.find(end, at);
    if (last != bytes_.npos && bytes_.substr(at, last - at).find(word) != bytes_.npos)
      edits_.push_back({at, last + end.size() - at, ""});
  }

  void set(const XmlElement& element, std::string_view property, const std::string& value) {
    const XmlElement* child = element.child(property);
    if (!child)
      insert(element, element_text(property, value));
    else if (child->inside.data() == nullptr)
      insert(*child, value);
    else
      edits_.push_back({place_of(child->inside), child->inside.size(), value});
  }

  /// An element that holds none of its own name.
  void remove(const XmlElement& element) {
    const std::size_t name = place_of(element.name);
    const std::size_t last = element.children.empty() && element.inside.data() == nullptr
                                 ? tag_end(element)
                                 : bytes_.find('>', bytes_.find(fmt::format("</{}", element.name), name));
    edits_.push_back({name - 1, last + 2 - name, ""});
  }

  std::string text() && {
    for (const auto& [end, inserted] : inserted_) {
      const auto& [name, text] = inserted;
      if (bytes_[end - 1] == '/')
        edits_.push_back({end - 1, 2, fmt::format(">{}</{}>", text, name)});
      else
        edits_.push_back({end + 1, 0, text});
    }
    // What is put at a place before what is taken away from there on.
    std::stable_sort(edits_.begin(), edits_.end(), [](const Edit& one, const Edit& other) {
      return std::pair(one.at, one.length) < std::pair(other.at, other.length);
    });
    std::string out;
    std::size_t at = 0;
    for (const Edit& edit : edits_) {
      out.append(bytes_.substr(at, edit.at - at)).append(edit.text);
      at = edit.at + edit.length;
    }
    return out.append(bytes_.substr(at));
  }

 private:
  struct Edit {
    std::size_t at, length;
    std::string text;
  };

  std::size_t place_of(std::string_view part) const {
    return static_cast<std::size_t>(part.data() - bytes_.data());
  }

  /// Where the '>' of its opening tag stands; values of attributes may have one too.
  std::size_t tag_end(const XmlElement& element) const {
    char quote = 0;
    for (std::size_t at = place_of(element.name);; ++at) {
      const char c = bytes_[at];
      if (quote == 0 && c == '>') return at;
      if (quote == 0 && (c == '"' || c == '\''))
        quote = c;
      else if (c == quote)
        quote = 0;
    }
  }

  std::string_view bytes_;
  std::string line_end_;
  std::vector<Edit> edits_;
  std::map<std::size_t, std::pair<std::string_view, std::string>>
      inserted_;  ///< by where the opening tag ends
};

/// All elements of coordinates with this name, of a joint with that name if it is given.
void find_coordinates(const XmlElement& in, const std::string& joint, const std::string& name,
                      bool is_of_joint, std::vector<const XmlElement*>& found) {
  for (const XmlElement& child : in.children) {
    if (child.name == "defaults") continue;  // holds elements that are of nothing
    if (child.name == "Coordinate" && is_of_joint && child.label() == name) found.push_back(&child);
    find_coordinates(child, joint, name,
                     is_joint(child.name) ? joint.empty() || child.label() == joint : is_of_joint, found);
  }
}

}  // namespace

bool is_own_force(std::string_view name, std::string_view coordinate) {
  return name == std::string(limit_name).append(coordinate) ||
         name == std::string(linear_name).append(coordinate);
}

std::string range_text(const CoordinateRange& range) {
  return fmt::format("{} {}", range.lower_deg * radians, range.upper_deg * radians);
}

std::string force_element(const CoordinateRange& range, StopForce stop) {
  const Force force = force_of(range, stop);
  std::string text = fmt::format("<{} name=\"{}\">", force.element, xml_escaped(force.name));
  for (const auto& [property, value] : force.properties) text += element_text(property, value);
  return text + fmt::format("</{}>\n", force.element);
}

std::string with_limits(std::string_view model, const std::filesystem::path& path, const std::string& joint,
                        std::span<const CoordinateRange> ranges, StopForce stop, std::string_view comment) {
  const std::string file = path.string();
  const std::string_view bytes = without_byte_order_mark(model);
  const Source source{bytes, file};
  const XmlElement root = xml_tree(source);
  const XmlElement* of_model = root.child("Model");
  if (root.name != "OpenSimDocument" || !of_model) source.fail("no OpenSim model");
  const XmlElement* set = of_model->child("ForceSet");
  const XmlElement* forces = set ? set->child("objects") : nullptr;
  EditedXml edited(bytes);
  edited.remove_comment(root, "# condyle_version: ");
  edited.insert(root, fmt::format("\n{}", comment));
  std::string added;
  for (const CoordinateRange& range : ranges) {
    std::vector<const XmlElement*> found;
    find_coordinates(*of_model, joint, range.coordinate, false, found);
    if (found.size() != 1)
      source.fail(fmt::format("joint {} has {} coordinate {}", in_quotes(joint),
                              found.empty() ? "no" : "more than one", in_quotes(range.coordinate)));
    if (const XmlElement* otherwise = found.front()->child("default_value")) {
      double value = 0;
      if (range.lower_deg < range.upper_deg && parse_number(otherwise->text(), value) &&
          !(value >= range.lower_deg * radians && value <= range.upper_deg * radians))
        source.fail(
            fmt::format("line {}: the default_value {} of {} is outside of what is written, {}: OpenSim "
                        "refuses such a model",
                        otherwise->line, value, in_quotes(range.coordinate), range_text(range)));
    }
    edited.set(*found.front(), "range", range_text(range));
    edited.set(*found.front(), "clamped", "true");
    const auto written_before = [&](const Force& force) -> const XmlElement* {
      if (!forces) return nullptr;
      const auto found_force = std::find_if(
          forces->children.begin(), forces->children.end(),
          [&](const XmlElement& each) { return each.name == force.element && each.label() == force.name; });
      return found_force == forces->children.end() ? nullptr : &*found_force;
    };
    if (const XmlElement* other =
            written_before(force_of(range, stop == StopForce::limit ? StopForce::linear : StopForce::limit)))
      edited.remove(*other);
    const Force force = force_of(range, stop);
    if (const XmlElement* before = written_before(force))
      for (const auto& [property, value] : force.properties) edited.set(*before, property, value);
    else
      added += force_element(range, stop);
  }
  if (!added.empty()) {
    if (forces)
      edited.insert(*forces, "\n" + added);
    else if (set)
      edited.insert(*set, fmt::format("<objects>\n{}</objects>", added));
    else
      edited.insert(*of_model,
                    fmt::format("\n<ForceSet name=\"forceset\"><objects>\n{}</objects></ForceSet>", added));
  }
  return std::string(model.substr(0, model.size() - bytes.size())) + std::move(edited).text();
}

}  // namespace condyle::io
