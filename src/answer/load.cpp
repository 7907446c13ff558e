#include <array>

#include "answer/foundation_caveat.hpp"
#include "condyle/answer.hpp"
#include "condyle/error.hpp"

namespace condyle {

void check_load_request(const LoadRequest& request) {
  if (request.load && !request.load->on_mobile.moment_nmm.isZero(0) && !request.balance.free_rotations)
    throw UsageError("moment: needs free rotations: nothing else balances it");
}

LoadAnswer answer_load(const contact::ElasticContact& surfaces, const LoadRequest& request) {
  check_load_request(request);
  LoadAnswer answer{.X_FM = request.X_FM, .notes = motion::check_layers(surfaces, request.names)};
  answer.caveats.emplace_back(answer::foundation_caveat);
  if (request.load) {
    motion::add_new(answer.notes, motion::check_load(*request.load));
    answer.balanced = contact::balance(surfaces, request.X_FM, *request.load, request.balance);
    answer.X_FM = answer.balanced->X_FM;
    answer.contact = answer.balanced->contact;
    answer.ligaments = ligaments_along(request.balance.ligaments, {answer.X_FM});
    motion::add_new(answer.notes,
                    motion::check_ligaments(answer.ligaments, std::array{std::optional(answer.X_FM)}));
    if (!answer.carries_load()) return answer;
  } else {
    answer.contact = surfaces.at(request.X_FM);
  }
  answer.cut_off_by_reach = surfaces.cut_off_by_reach(answer.X_FM);
  answer.refined_force_n = surfaces.refined_force_n(answer.X_FM);
  motion::add_new(answer.notes, motion::check_contact(answer.contact, request.names));
  if (!request.limits && !request.about) return answer;
  const contact::JointContact bodies(surfaces.fixed(), surfaces.mobile());
  if (request.limits)
    answer.standing = pose_standing(*request.limits, angles_at(request.limits->coordinates(), answer.X_FM),
                                    answer.X_FM.translation(), !bodies.pairs(answer.X_FM).empty());
  if (request.about)
    answer.arcs = arc_depths(bodies, *request.about, request.system, answer.X_FM,
                             angles_at(request.system, answer.X_FM));
  return answer;
}

}  // namespace condyle
