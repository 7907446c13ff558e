#ifndef CONDYLE_CONDYLE_H
#define CONDYLE_CONDYLE_H

#include <stddef.h>
#include <stdint.h>

/// The C interface, of the shared library libcondyle_c.so.1: meshes, contact of two bodies at a pose, depths along normals,
/// elastic contact with forces for simulators, and rotation about an axis or a slide up to contact; contacts follow bodies that deform.
/// docs/c-interface.md. C99 and C++; link with -lcondyle_c.
///
/// Units: mm, N, N mm, MPa, s; angles are degrees, angular velocities rad/s. Frames: F is that of the fixed body, M that of the mobile body; a pose X_FM
/// has p_F = X_FM p_M. Points are x, y, z one after the other.
///
/// Errors: every function that can fail returns a condyle_status, CONDYLE_OK or what went wrong, and condyle_last_error() has a
/// line about it. What a function would have written it then leaves alone, unless it says otherwise. No exception leaves
/// the library, and it neither prints nor exits.
///
/// Ownership: whatever a _create function gives is the caller's, who hands it back once to the _destroy function of its kind; that takes
/// NULL too. Arrays passed in are copied. Pointers that a function gives into results are good until the results are
/// queried for again or destroyed.
///
/// Threads: any number of threads may query one object at a time, each with results of its own; queries use the threads of
/// oneTBB, and answers do not depend on how many these are. Options, results, and whatever a function takes without const
/// belong to one thread at a time.
///
/// Updates: a body of a contact that has deformed gets new positions of all vertices, x, y, z one after the other in its own frame, as
/// many as there were; or of some, each named once. Answers are those of an object made anew. CONDYLE_BAD_ARGUMENT if numbers differ, before
/// anything is read, and if a number is no vertex's or is there twice; CONDYLE_BAD_MESH if a coordinate is not finite or beyond 1e30 mm. A refused update changes
/// nothing. Not while another thread queries. Objects made from the same meshes, and results, stay as they are.
///
/// Growth: names and structs of this header stay as they are as long as the library is libcondyle_c.so.1. What is
/// added has a name of its own.

#if defined(__GNUC__)
#define CONDYLE_API __attribute__((visibility("default")))
#else
#define CONDYLE_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/// What a function answers: one of the values below.
typedef int condyle_status;
enum {
  CONDYLE_OK = 0,
  CONDYLE_BAD_ARGUMENT = 1,   ///< a null pointer, a value outside its domain, results without an answer
  CONDYLE_BAD_MESH = 2,       ///< a mesh does not allow the query: a bad index, an open surface
  CONDYLE_OUT_OF_MEMORY = 3,  ///< objects passed in are as usable as before, but for some updates that say so
  CONDYLE_INTERNAL_ERROR = 4  ///< a mistake of the library
};

/// One line about the last call of this thread that failed, in English, of at most 1023 bytes; empty if none did. Good until
/// the next call that fails in this thread.
CONDYLE_API const char* condyle_last_error(void);

/// Version of the library: "0.2.0".
CONDYLE_API const char* condyle_version(void);

/// Which of the two bodies.
typedef int condyle_body;
enum { CONDYLE_FIXED = 0, CONDYLE_MOBILE = 1 };

/// A rigid motion: p_F[i] = sum over k of rotation[3 i + k] p_M[k], plus translation_mm[i]. The rotation is row-major, its rows
/// orthonormal to 1e-6 and without reflection; the translation is at most 1e30 mm. Else CONDYLE_BAD_ARGUMENT.
typedef struct condyle_pose {
  double rotation[9];
  double translation_mm[3];
} condyle_pose;

// ---- meshes ---------------------------------------------------------------------------------------------------------------

/// A triangle mesh that was checked. Immutable; objects made from it keep what they need of it, so it may be destroyed
/// before they are.
typedef struct condyle_mesh condyle_mesh;

/// From `vertex_count` points in mm and `triangle_count` triples of vertex numbers from 0, counter-clockwise seen from outside.
/// CONDYLE_BAD_MESH names the first bad element: "triangle 812 uses vertex 40991 of 40000". Linear.
CONDYLE_API condyle_status condyle_mesh_create(const double* xyz_mm, size_t vertex_count,
                                               const uint32_t* triangles, size_t triangle_count,
                                               condyle_mesh** mesh);
CONDYLE_API void condyle_mesh_destroy(condyle_mesh* mesh);

/// 0 for NULL.
CONDYLE_API size_t condyle_mesh_vertex_count(const condyle_mesh* mesh);
CONDYLE_API size_t condyle_mesh_triangle_count(const condyle_mesh* mesh);
/// 1 if every edge is used as often in one direction as in the other, so that the surface has an inside; else, and for NULL, 0.
CONDYLE_API int condyle_mesh_is_closed(const condyle_mesh* mesh);

// ---- contact at a pose ----------------------------------------------------------------------------------------------------

/// A fixed and a mobile body, each in its own frame with the joint centre as origin. Depths and gaps are radial: along the ray
/// from the centre. Tables are built by the first query that needs them.
typedef struct condyle_joint_contact condyle_joint_contact;

/// Open meshes are accepted: they have no inside, but triangles that meet.
CONDYLE_API condyle_status condyle_joint_contact_create(const condyle_mesh* fixed, const condyle_mesh* mobile,
                                                        condyle_joint_contact** contact);
CONDYLE_API void condyle_joint_contact_destroy(condyle_joint_contact* contact);

/// A body has deformed: "Updates" above. CONDYLE_BAD_MESH also if the surface now holds the joint centre. Neither a refused update nor
/// CONDYLE_OUT_OF_MEMORY changes anything. Vertices inside keep the order that the contact was made with.
CONDYLE_API condyle_status condyle_joint_contact_update(condyle_joint_contact* contact, condyle_body body,
                                                        const double* xyz_mm, size_t vertex_count);
CONDYLE_API condyle_status condyle_joint_contact_update_some(condyle_joint_contact* contact,
                                                             condyle_body body, const uint32_t* vertices,
                                                             size_t count, const double* xyz_mm);

/// What a query found at one pose. Vertices reuse the memory of the query before: once there is enough, they allocate nothing.
typedef struct condyle_contact_results condyle_contact_results;

CONDYLE_API condyle_status condyle_contact_results_create(condyle_contact_results** results);
CONDYLE_API void condyle_contact_results_destroy(condyle_contact_results* results);

/// Vertices of each body that are inside the other or on its surface, and the triangles that intersect. CONDYLE_BAD_MESH if the
/// joint centre lies on a surface. After an error the results have no answer.
CONDYLE_API condyle_status condyle_joint_contact_at(const condyle_joint_contact* contact,
                                                    const condyle_pose* X_FM,
                                                    condyle_contact_results* results);

/// Whether the bodies share a point, 1 or 0; ends at the first witness found, so sooner than condyle_joint_contact_at().
CONDYLE_API condyle_status condyle_joint_contact_in_contact(const condyle_joint_contact* contact,
                                                            const condyle_pose* X_FM, int* in_contact);

/// How deep two bodies are in each other at a pose; points are in the frame of the fixed body, mm. Numbers that there are none of are NaN.
typedef struct condyle_touch {
  int in_contact;
  size_t intersecting_pairs;
  int inside;  ///< CONDYLE_FIXED or CONDYLE_MOBILE, the body that is wholly inside the other; else -1
  double nearest_distance_mm;  ///< between surfaces that do not meet
  double nearest_fixed_mm[3], nearest_mobile_mm[3];
  int deepest_of;  ///< the body whose surface has the deepest place; -1 if nothing of a surface is inside the other body
  double depth_mm, depth_error_mm;  ///< no place is deeper by more
  double depth_bound_mm;            ///< no place is deeper; known without a deepest place too
  double place_mm[3], exit_mm[3];   ///< the nearest point of the other surface
  double volume_mm3, volume_error_mm3, fixed_area_mm2, mobile_area_mm2;  ///< only `with_measures` != 0
  /// Likewise, how much of the volume is counted again because a body covers it more than once.
  double fixed_covered_again_mm3, mobile_covered_again_mm3;
} condyle_touch;

/// Depth over the whole of both surfaces, whatever their triangles. A body that is open or inside out has no inside: what needs it is
/// none. CONDYLE_BAD_MESH if a mesh has no triangle.
CONDYLE_API condyle_status condyle_joint_contact_touch(const condyle_joint_contact* contact,
                                                       const condyle_pose* X_FM, int with_measures,
                                                       condyle_touch* touch);

/// The radial gap of every vertex of `body` to the other body, mm: > 0 apart, < 0 penetrating, 0 on the surface; infinite if its ray
/// meets nothing. `count` is the number of the body's vertices. CONDYLE_BAD_MESH if the other body is open.
CONDYLE_API condyle_status condyle_joint_contact_radial_gaps(const condyle_joint_contact* contact,
                                                             const condyle_pose* X_FM, condyle_body body,
                                                             double* gaps_mm, size_t count);

/// The same along circles about a line of F, which goes through a point, in mm, along a direction of any length but zero: the
/// angle by which a vertex must rotate, degrees, and its arc, mm; either array may be NULL. Minus infinite inside if no rotation frees it.
CONDYLE_API condyle_status condyle_joint_contact_arc_gaps(const condyle_joint_contact* contact,
                                                          const condyle_pose* X_FM,
                                                          const double axis_point_mm[3],
                                                          const double axis_direction[3], condyle_body body,
                                                          double* gaps_deg, double* gaps_mm, size_t count);

/// Values of `state` and `direction` below.
enum { CONDYLE_ON_SURFACE = 1, CONDYLE_INSIDE = 2 };
enum { CONDYLE_TOWARDS_CENTRE = 0, CONDYLE_AWAY_FROM_CENTRE = 1 };

/// The vertices of one body that are not outside the other, one array for each quantity, `count` long. Vertices that are
/// neighbours in space follow each other; their numbers do not ascend.
typedef struct condyle_vertices_inside {
  int other_is_closed;  ///< 0 if the other body has no inside: then nothing is known, and count is 0
  size_t count;
  const uint32_t* vertex;
  const uint8_t* state;      ///< CONDYLE_INSIDE or CONDYLE_ON_SURFACE
  const double* depth_mm;    ///< along the ray to the nearer exit, >= 0
  const uint32_t* triangle;  ///< of the other body: where the ray leaves it, or one that the vertex lies on
  const uint8_t* direction;  ///< along the ray to that triangle
} condyle_vertices_inside;

/// CONDYLE_BAD_ARGUMENT before the first answer, as the next three.
CONDYLE_API condyle_status condyle_contact_results_vertices(const condyle_contact_results* results,
                                                            condyle_body body, condyle_vertices_inside* out);
/// The angle between the ray of each vertex and the normal of its triangle, degrees from 0 to 90, in the order of
/// condyle_vertices_inside, whose `count` it takes. It tells depths from mere lengths: through a flat wall at 60 degrees from the ray the
/// radial depth is twice the shortest exit, and beyond that it means nothing. A function of its own: the angle costs more than all else
/// of a vertex. `results` are the last ones of this contact; after an update the angles are those of the bodies as they are now.
CONDYLE_API condyle_status condyle_joint_contact_ray_angles(const condyle_joint_contact* contact,
                                                            condyle_contact_results* results,
                                                            condyle_body body, double* angles_deg,
                                                            size_t count);
/// The exact set of pairs of triangles that share a point, ascending: pairs[2 i] of the fixed body, pairs[2 i + 1] of the mobile body,
/// i < pair_count.
CONDYLE_API condyle_status condyle_contact_results_pairs(const condyle_contact_results* results,
                                                         const uint32_t** pairs, size_t* pair_count);
/// 1 if surfaces meet or a body is wholly inside the other, else 0.
CONDYLE_API condyle_status condyle_contact_results_in_contact(const condyle_contact_results* results,
                                                              int* in_contact);

// ---- depth along normals --------------------------------------------------------------------------------------------------

/// A face of the casting surface in contact. Integrals are over the part in contact, in the frame of the casting body.
typedef struct condyle_face_contact {
  uint32_t face;
  double area_mm2;  ///< of the part in contact
  double max_depth_mm;
  double overlap_mm3;            ///< integral of the depth
  double overlap_moment_mm4[3];  ///< integral of depth times place
  double max_pressure_mpa;       ///< pressures and loads are 0 of depths without layers
  double load_n;                 ///< integral of the pressure
  double load_moment_nmm[3];     ///< integral of pressure times place
} condyle_face_contact;

/// Faces in contact, and sums over them, in the frame of the casting body.
typedef struct condyle_surface_contact {
  int is_cast;  ///< 0 if this body's surface is not cast: then all else is 0
  size_t face_count;
  const condyle_face_contact* faces;  ///< ascending
  double area_mm2;
  double mean_depth_mm, max_depth_mm;
  double mean_pressure_mpa, max_pressure_mpa;
  int has_centre_of_depth, has_centre_of_pressure;  ///< 0 without contact; the centre is then 0
  double centre_of_depth_mm[3];                     ///< weighted by depth times area
  double centre_of_pressure_mm[3];                  ///< weighted by pressure times area
  double force_n[3];                                ///< on the casting body: the sum of -p A n
  double moment_nmm[3];                             ///< the same about the origin of its frame
  /// Rays that met the front of an open target: the casting point is outside of its body, if it has one. Counted all the same.
  size_t met_from_front;
  size_t rim_faces;  ///< faces at the rim of the target, which are cut there
  /// Overlapping area whose rays meet the target more than 60 degrees off its normal: their length is no depth.
  double oblique_area_mm2;
  int peak_is_oblique;  ///< with CONDYLE_FACE_CENTRE: the largest depth or pressure comes from such a ray
  double max_strain;    ///< the largest depth over the thickness of both layers there
} condyle_surface_contact;

/// What a face contributes: the part where the depth, linear between rays from its corners, is above 0; or the whole face with the
/// depth at its centre, the rule of OpenSim-JAM.
typedef int condyle_face_rule;
enum { CONDYLE_FACE_CENTRE = 0, CONDYLE_CUT_FACES = 1 };

/// Rays along the negative normals of a casting surface to a target surface. Both may be open.
typedef struct condyle_normal_depth condyle_normal_depth;

/// `reach_mm` > 0 is how far rays go; 20 is usual.
CONDYLE_API condyle_status condyle_normal_depth_create(const condyle_mesh* casting,
                                                       const condyle_mesh* target, condyle_face_rule rule,
                                                       double reach_mm, condyle_normal_depth** depth);
CONDYLE_API void condyle_normal_depth_destroy(condyle_normal_depth* depth);

/// A surface has deformed: "Updates" above. After CONDYLE_OUT_OF_MEMORY an update may have ended halfway: queries and updates are then
/// refused by CONDYLE_BAD_ARGUMENT, and the object has to be made anew.
CONDYLE_API condyle_status condyle_normal_depth_update_casting(condyle_normal_depth* depth,
                                                               const double* xyz_mm, size_t vertex_count);
CONDYLE_API condyle_status condyle_normal_depth_update_casting_some(condyle_normal_depth* depth,
                                                                    const uint32_t* vertices, size_t count,
                                                                    const double* xyz_mm);
CONDYLE_API condyle_status condyle_normal_depth_update_target(condyle_normal_depth* depth,
                                                              const double* xyz_mm, size_t vertex_count);
CONDYLE_API condyle_status condyle_normal_depth_update_target_some(condyle_normal_depth* depth,
                                                                   const uint32_t* vertices, size_t count,
                                                                   const double* xyz_mm);

typedef struct condyle_normal_results condyle_normal_results;

CONDYLE_API condyle_status condyle_normal_results_create(condyle_normal_results** results);
CONDYLE_API void condyle_normal_results_destroy(condyle_normal_results* results);

/// X_CT is the pose of the target in the casting body: X_FM if the fixed body is cast, its inverse if the mobile one is. After an
/// error the results have no answer.
CONDYLE_API condyle_status condyle_normal_depth_at(const condyle_normal_depth* depth,
                                                   const condyle_pose* X_CT, condyle_normal_results* results);
CONDYLE_API condyle_status condyle_normal_results_surface(const condyle_normal_results* results,
                                                          condyle_surface_contact* out);

// ---- elastic contact ------------------------------------------------------------------------------------------------------

/// Which surface is cast; with both the load is the mean of the two.
typedef int condyle_casting;
enum { CONDYLE_CAST_FIXED = 0, CONDYLE_CAST_MOBILE = 1, CONDYLE_CAST_BOTH = 2 };

/// Pressure of an overlap d of a layer of thickness h: M d / h, or -M ln(1 - d / h); M is the modulus of a layer that cannot
/// spread sideways.
typedef int condyle_pressure_law;
enum { CONDYLE_LINEAR = 0, CONDYLE_LOGARITHMIC = 1 };

/// Options of elastic contact: both surfaces cast, cut faces, reach 20 mm, the linear law, and no layer, until they are set.
typedef struct condyle_elastic_options condyle_elastic_options;

CONDYLE_API condyle_status condyle_elastic_options_create(condyle_elastic_options** options);
CONDYLE_API void condyle_elastic_options_destroy(condyle_elastic_options* options);
CONDYLE_API condyle_status condyle_elastic_options_set_casting(condyle_elastic_options* options,
                                                               condyle_casting casting);
CONDYLE_API condyle_status condyle_elastic_options_set_law(condyle_elastic_options* options,
                                                           condyle_pressure_law law);
CONDYLE_API condyle_status condyle_elastic_options_set_rays(condyle_elastic_options* options,
                                                            condyle_face_rule rule, double reach_mm);
/// The layer of a body: `thickness_count`, of which so many are read, is 1 for one thickness, or the number of the body's vertices, each with its own. A body
/// without a layer is rigid, and one of the two needs one. Values are checked by condyle_elastic_contact_create(): modulus > 0,
/// Poisson's ratio > -1 and < 0.5, thicknesses > 0.
CONDYLE_API condyle_status condyle_elastic_options_set_layer(condyle_elastic_options* options,
                                                             condyle_body body, double youngs_modulus_mpa,
                                                             double poisson_ratio, const double* thickness_mm,
                                                             size_t thickness_count);

/// Two surfaces with their layers: an elastic foundation.
typedef struct condyle_elastic_contact condyle_elastic_contact;

/// The options are copied. CONDYLE_BAD_ARGUMENT for one that is outside its domain, and without a layer.
CONDYLE_API condyle_status condyle_elastic_contact_create(const condyle_mesh* fixed,
                                                          const condyle_mesh* mobile,
                                                          const condyle_elastic_options* options,
                                                          condyle_elastic_contact** contact);
CONDYLE_API void condyle_elastic_contact_destroy(condyle_elastic_contact* contact);

/// A body has deformed: "Updates" above. Thicknesses stay with their vertices. After CONDYLE_OUT_OF_MEMORY an update may have ended
/// halfway: queries and updates are then refused by CONDYLE_BAD_ARGUMENT, and the contact has to be made anew.
CONDYLE_API condyle_status condyle_elastic_contact_update(condyle_elastic_contact* contact, condyle_body body,
                                                          const double* xyz_mm, size_t vertex_count);
CONDYLE_API condyle_status condyle_elastic_contact_update_some(condyle_elastic_contact* contact,
                                                               condyle_body body, const uint32_t* vertices,
                                                               size_t count, const double* xyz_mm);

typedef struct condyle_elastic_results condyle_elastic_results;

CONDYLE_API condyle_status condyle_elastic_results_create(condyle_elastic_results** results);
CONDYLE_API void condyle_elastic_results_destroy(condyle_elastic_results* results);

/// CONDYLE_BAD_MESH with the logarithmic law if the overlap reaches the thickness. After an error the results have no answer.
CONDYLE_API condyle_status condyle_elastic_contact_at(const condyle_elastic_contact* contact,
                                                      const condyle_pose* X_FM,
                                                      condyle_elastic_results* results);

typedef struct condyle_wrench {
  double force_n[3];
  double moment_nmm[3];
} condyle_wrench;

/// The load of the fixed body on the mobile one, in F, about the origin of M; and what is stored in the layers, N mm.
CONDYLE_API condyle_status condyle_elastic_results_load(const condyle_elastic_results* results,
                                                        condyle_wrench* on_mobile, double* energy_nmm);
/// The surface of one body, in its own frame.
CONDYLE_API condyle_status condyle_elastic_results_surface(const condyle_elastic_results* results,
                                                           condyle_body body, condyle_surface_contact* out);

// ---- forces for a simulator -----------------------------------------------------------------------------------------------

/// What condyle_elastic_contact_forces() computes, and how: without motion, friction and damping, the factor 1, the load only,
/// until they are set. A setter refuses a value outside its domain by CONDYLE_BAD_ARGUMENT and leaves the options as they were.
/// docs/contact.md has the formulas.
typedef struct condyle_force_options condyle_force_options;

CONDYLE_API condyle_status condyle_force_options_create(condyle_force_options** options);
CONDYLE_API void condyle_force_options_destroy(condyle_force_options* options);
/// Of the mobile body relative to the fixed one, in F: velocity of the origin of M, mm/s, and angular velocity, rad/s. Friction and damping
/// depend on it.
CONDYLE_API condyle_status condyle_force_options_set_motion(condyle_force_options* options,
                                                            const double velocity_mm_s[3],
                                                            const double angular_velocity_rad_s[3]);
/// The traction is coefficient p v / sqrt(v^2 + s^2) against the sliding velocity v, with the slip velocity s > 0, 1 mm/s until set:
/// Coulomb's friction, made smooth about v = 0. Nothing sticks. The coefficient is >= 0.
CONDYLE_API condyle_status condyle_force_options_set_friction(condyle_force_options* options,
                                                              double coefficient, double slip_velocity_mm_s);
/// Hunt and Crossley's, >= 0: pressures are multiplied by max(0, 1 + damping * rate of depth).
CONDYLE_API condyle_status condyle_force_options_set_damping(condyle_force_options* options,
                                                             double damping_s_per_mm);
/// From 0 to 1: pressures, energy and stiffness are multiplied by it. condyle_ramp_factor_at() has one for each time.
CONDYLE_API condyle_status condyle_force_options_set_factor(condyle_force_options* options, double factor);
/// What is computed besides the load: a sum of these values. Vertex forces come with the vertex stiffness too.
enum { CONDYLE_STIFFNESS = 1, CONDYLE_VERTEX_FORCES = 2, CONDYLE_VERTEX_STIFFNESS = 4, CONDYLE_PATCHES = 8 };
CONDYLE_API condyle_status condyle_force_options_set_parts(condyle_force_options* options, int parts);

/// Forces at one pose. It keeps its memory from step to step: once there is enough, steps allocate nothing, but for rays from points so near
/// the surface of a closed body that only exact numbers decide on which side they are.
typedef struct condyle_force_results condyle_force_results;

CONDYLE_API condyle_status condyle_force_results_create(condyle_force_results** results);
CONDYLE_API void condyle_force_results_destroy(condyle_force_results* results);

/// CONDYLE_BAD_MESH as condyle_elastic_contact_at(). After an error the results have no answer.
CONDYLE_API condyle_status condyle_elastic_contact_forces(const condyle_elastic_contact* contact,
                                                          const condyle_pose* X_FM,
                                                          const condyle_force_options* options,
                                                          condyle_force_results* results);

typedef struct condyle_force_load {
  condyle_wrench on_mobile;  ///< in F, about the origin of M, with friction and damping
  double energy_nmm;         ///< stored in the layers
  double friction_power;     ///< taken out of the motion, N mm/s, >= 0
  double damping_power;      ///< the same
  double max_strain;  ///< the largest depth over the layers' thickness; above 1 the forces mean nothing
  double factor;  ///< as it was set: below 1 a ramp is in force, and nothing here is the layers' own answer
} condyle_force_load;

CONDYLE_API condyle_status condyle_force_results_load(const condyle_force_results* results,
                                                      condyle_force_load* out);

/// 6 x 6, row-major: minus the derivative of the wrench. Rows are force and moment; columns a translation of the mobile body (mm) and a
/// rotation (rad) about the origin of M, both in F, which carry the origin of M along. A contact that pushes back has positive
/// eigenvalues in its symmetric part. Of the elastic part, friction and damping left out; not symmetric. CONDYLE_BAD_ARGUMENT if the
/// options did not have it, as the parts below.
CONDYLE_API condyle_status condyle_force_results_stiffness(const condyle_force_results* results,
                                                           double stiffness[36]);

/// The vertices of a body with a share in the contact, ascending. Those of the mobile body add up to the wrench, those of the fixed body to
/// its reverse, moments too.
typedef struct condyle_vertex_forces {
  size_t count;
  const uint32_t* vertex;
  const double* force_n;  ///< x, y, z of each vertex, in the frame of its body
} condyle_vertex_forces;

CONDYLE_API condyle_status condyle_force_results_vertices(const condyle_force_results* results,
                                                          condyle_body body, condyle_vertex_forces* out);

/// Minus the derivative of the elastic force on one vertex when another is moved, N/mm, with areas, normals, directions of rays,
/// triangles met and shares of vertices held. Ascending by row, then by column; what is not there is 0.
typedef struct condyle_vertex_stiffness {
  size_t count;
  const uint32_t*
      row;  ///< places in the vertices of the fixed body, and after these in those of the mobile body
  const uint32_t* column;  ///< the same
  const double*
      block;  ///< 3 x 3 each, row-major: rows in the frame of the row's body, columns in that of the column's
} condyle_vertex_stiffness;

CONDYLE_API condyle_status condyle_force_results_vertex_stiffness(const condyle_force_results* results,
                                                                  condyle_vertex_stiffness* out);

/// Faces in contact that hang together by common vertices.
typedef struct condyle_force_patch {
  condyle_body casting;  ///< whose faces they are
  size_t face_count;
  const uint32_t* faces;            ///< ascending
  double area_mm2;                  ///< in contact
  double max_pressure_mpa;          ///< elastic, times the factor: without damping
  double load_n;                    ///< integral of the pressure
  condyle_wrench on_mobile;         ///< what it adds to that of the contact
  double centre_of_pressure_mm[3];  ///< in F; that of the area if the load is 0
  double centre_of_area_mm[3];      ///< in F
} condyle_force_patch;

/// Those of the fixed body's faces, then of the mobile one's, each by their first face.
CONDYLE_API condyle_status condyle_force_results_patches(const condyle_force_results* results,
                                                         const condyle_force_patch** patches,
                                                         size_t* patch_count);

/// Brings a contact in smoothly that overlaps before the first step, as after loading meshes: from nothing to all of it.
typedef struct condyle_ramp condyle_ramp;

/// X_FM is the first pose; `duration_s` > 0. The contact may be destroyed before it.
CONDYLE_API condyle_status condyle_ramp_create(const condyle_elastic_contact* contact,
                                               const condyle_pose* X_FM, double duration_s,
                                               condyle_ramp** ramp);
CONDYLE_API void condyle_ramp_destroy(condyle_ramp* ramp);
/// At the first pose; 0 for NULL, and if nothing overlaps there.
CONDYLE_API double condyle_ramp_max_depth_mm(const condyle_ramp* ramp);
CONDYLE_API double condyle_ramp_energy_nmm(const condyle_ramp* ramp);
/// 3 s^2 - 2 s^3 at the share s of the duration: 0 before it, 1 after it. 1 throughout if nothing overlaps at the first pose, and for
/// NULL.
CONDYLE_API double condyle_ramp_factor_at(const condyle_ramp* ramp, double time_s);

// ---- rotation about an axis -----------------------------------------------------------------------------------------------

/// Two bodies made ready for rotations of the mobile one about one axis that stays in the fixed one.
typedef struct condyle_first_contact condyle_first_contact;

/// The axis goes through a point, in mm, along a direction of any length but zero, both in F.
CONDYLE_API condyle_status condyle_first_contact_create(const condyle_mesh* fixed, const condyle_mesh* mobile,
                                                        const double axis_point_mm[3],
                                                        const double axis_direction[3],
                                                        condyle_first_contact** first_contact);
CONDYLE_API void condyle_first_contact_destroy(condyle_first_contact* first_contact);

/// Why a rotation ends: the surfaces meet there and not before; nothing meets in the whole range; or the bodies are in
/// contact at the start already.
enum { CONDYLE_CONTACT = 0, CONDYLE_END_OF_RANGE = 1, CONDYLE_CONTACT_AT_START = 2 };

enum { CONDYLE_VERTEX = 0, CONDYLE_EDGE = 1, CONDYLE_FACE = 2 };

/// A vertex or a face by its number, an edge by its two vertices, ascending.
typedef struct condyle_feature {
  int kind;
  uint32_t id;
  uint32_t other_end;  ///< edges only, else 0xffffffff
} condyle_feature;

/// How far the mobile body turns in one sense.
typedef struct condyle_rotation_limit {
  double turned_deg;       ///< from the start, >= 0 in either sense
  double error_bound_deg;  ///< contact is at turned_deg or past it by at most this, never before
  int reason;
  int has_witness;  ///< 0 without contact, or if a body is inside the other and surfaces do not meet
  condyle_feature fixed_feature, mobile_feature;  ///< what meets
  double fixed_point_mm[3], mobile_point_mm[3];   ///< where, each in its own body's frame
} condyle_rotation_limit;

/// How far the mobile body turns about the axis from X_FM before anything meets, in closed form, with no step. The range is from
/// `negative_deg`, -360 to 0, to `positive_deg`, 0 to 360; positive is counter-clockwise seen from the tip of the direction.
CONDYLE_API condyle_status condyle_first_contact_limits(const condyle_first_contact* first_contact,
                                                        const condyle_pose* X_FM, double negative_deg,
                                                        double positive_deg, condyle_rotation_limit* negative,
                                                        condyle_rotation_limit* positive);

// ---- turns and slides -----------------------------------------------------------------------------------------------------

/// All that is free of a turn, in degrees, or of a slide, in mm, from the start: nothing meets between `low` and `high`, and contact is
/// outside by no more than the error bounds.
typedef struct condyle_free_interval {
  double low, high;
  double low_error_bound, high_error_bound;
} condyle_free_interval;

/// The free intervals of the last turn or slide.
typedef struct condyle_free_results condyle_free_results;

CONDYLE_API condyle_status condyle_free_results_create(condyle_free_results** results);
CONDYLE_API void condyle_free_results_destroy(condyle_free_results* results);

/// The mobile body turns about an axis of F from X_FM: first contact in both senses, up to a whole turn, and with `results` every interval
/// of a whole turn in which the bodies are free. One that holds the start goes from below 0 to above, others lie between 0 and 360; a body
/// that meets nothing is free from -180 to 180. After an error the results have no answer.
CONDYLE_API condyle_status condyle_joint_contact_turn(const condyle_joint_contact* contact,
                                                      const condyle_pose* X_FM, const double axis_point_mm[3],
                                                      const double axis_direction[3],
                                                      condyle_rotation_limit* negative,
                                                      condyle_rotation_limit* positive,
                                                      condyle_free_results* results);

/// First contact of a slide.
typedef struct condyle_slide_limit {
  double moved_mm;  ///< along the direction, signed: 0 in contact at the start, infinite if nothing meets
  double error_bound_mm;  ///< contact is at moved_mm or past it by at most this, never before
  int reason;             ///< as of a rotation
  int has_witness;        ///< 0 without contact, and in contact at the start
  uint32_t fixed_triangle, mobile_triangle;      ///< what meets
  double fixed_point_mm[3], mobile_point_mm[3];  ///< where, each in its own body's frame
} condyle_slide_limit;

/// The mobile body slides along a direction of F, of any length but zero, from X_FM: likewise against and along it. The first interval
/// may begin at minus infinity and the last one end at infinity.
CONDYLE_API condyle_status condyle_joint_contact_slide(const condyle_joint_contact* contact,
                                                       const condyle_pose* X_FM, const double direction[3],
                                                       condyle_slide_limit* negative,
                                                       condyle_slide_limit* positive,
                                                       condyle_free_results* results);

/// Ascending; CONDYLE_BAD_ARGUMENT before the first answer.
CONDYLE_API condyle_status condyle_free_results_intervals(const condyle_free_results* results,
                                                          const condyle_free_interval** intervals,
                                                          size_t* interval_count);

#ifdef __cplusplus
}
#endif

#endif
