/* A needle that turns about the z axis and runs into a wall, and a block that is pressed into a soft plane. Both have closed
 * forms. In C99:
 *
 *     cc -std=c99 needle.c $(pkg-config --cflags --libs condyle-c) -o needle
 */
#include <condyle/condyle.h>
#include <stdio.h>
#include <stdlib.h>

/* Ends the program with the library's line. */
static void check(condyle_status status) {
  if (status == CONDYLE_OK) return;
  fprintf(stderr, "needle: %s\n", condyle_last_error());
  exit(EXIT_FAILURE);
}

/* The first three corners counter-clockwise seen from outside. */
static condyle_mesh* tetrahedron(const double corners[12]) {
  static const uint32_t triangles[] = {0, 1, 2, 0, 2, 3, 2, 1, 3, 1, 0, 3};
  condyle_mesh* mesh;
  check(condyle_mesh_create(corners, 4, triangles, 4, &mesh));
  return mesh;
}

static condyle_mesh* box(const double low[3], const double high[3]) {
  static const uint32_t triangles[] = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                                       2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
  double corners[24];
  condyle_mesh* mesh;
  for (int i = 0; i < 24; ++i) corners[i] = (i / 3) >> (i % 3) & 1 ? high[i % 3] : low[i % 3];
  check(condyle_mesh_create(corners, 8, triangles, 12, &mesh));
  return mesh;
}

static void turn(const condyle_mesh* wall, const condyle_mesh* needle, const condyle_pose* start) {
  static const double origin[3] = {0, 0, 0}, z[3] = {0, 0, 1};
  condyle_first_contact* about_z;
  condyle_rotation_limit negative, positive;
  check(condyle_first_contact_create(wall, needle, origin, z, &about_z));
  check(condyle_first_contact_limits(about_z, start, -360, 360, &negative, &positive));
  /* The tip, at 10 mm, meets the plane x = 5: asin(5 / 10). */
  printf("turns %.3f degrees, then vertex %u of the needle meets the wall at x = %.3f mm\n",
         positive.turned_deg, (unsigned)positive.mobile_feature.id, positive.fixed_point_mm[0]);
  condyle_first_contact_destroy(about_z);
}

static void penetrate(const condyle_mesh* wall, const condyle_mesh* needle, const condyle_pose* turned) {
  condyle_joint_contact* contact;
  condyle_contact_results* results;
  condyle_vertices_inside inside;
  check(condyle_joint_contact_create(wall, needle, &contact));
  check(condyle_contact_results_create(&results)); /* one for many poses: it keeps its memory */
  check(condyle_joint_contact_at(contact, turned, results));
  check(condyle_contact_results_vertices(results, CONDYLE_MOBILE, &inside));
  /* The tip is at (8, -6) and leaves along its ray through x = 5: 10 - 5 / 0.8. */
  for (size_t i = 0; i < inside.count; ++i)
    printf("vertex %u is %.3f mm inside\n", (unsigned)inside.vertex[i], inside.depth_mm[i]);
  condyle_contact_results_destroy(results);
  condyle_joint_contact_destroy(contact);
}

static void press(const condyle_mesh* plane, const condyle_mesh* block, const condyle_pose* lowered) {
  const double thickness_mm = 2;
  condyle_elastic_options* options;
  condyle_elastic_contact* contact;
  condyle_elastic_results* results;
  condyle_surface_contact surface;
  condyle_wrench load;
  double energy_nmm;
  check(condyle_elastic_options_create(&options));
  check(condyle_elastic_options_set_casting(options, CONDYLE_CAST_MOBILE));
  check(condyle_elastic_options_set_layer(options, CONDYLE_FIXED, 10, 0.25, &thickness_mm, 1));
  check(condyle_elastic_contact_create(plane, block, options, &contact));
  condyle_elastic_options_destroy(options);
  check(condyle_elastic_results_create(&results));
  check(condyle_elastic_contact_at(contact, lowered, results));
  check(condyle_elastic_results_load(results, &load, &energy_nmm));
  check(condyle_elastic_results_surface(results, CONDYLE_MOBILE, &surface));
  /* A layer that cannot spread: 12 MPa / 2 mm, times 0.3 mm, on 10 mm x 10 mm. */
  printf("%.3f N on %.3f mm2, %.3f N mm stored\n", load.force_n[1], surface.area_mm2, energy_nmm);
  condyle_elastic_results_destroy(results);
  condyle_elastic_contact_destroy(contact);
}

int main(void) {
  static const double wall_corners[] = {5, -30, -10, 5, 0, 30, 5, 30, -10, 15, 0, 0};
  static const double needle_corners[] = {1, -1, -1, -1, -1, 0, 1, -1, 1, 0, -10, 0};
  static const double plane_low[] = {-40, -10, -40}, plane_high[] = {40, 0, 40};
  static const double block_low[] = {-5, 0, -5}, block_high[] = {5, 5, 5};
  static const condyle_pose start = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};
  static const condyle_pose turned = {{0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1}, {0, 0, 0}};
  static const condyle_pose lowered = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, -0.3, 0}};
  condyle_mesh* wall = tetrahedron(wall_corners);
  condyle_mesh* needle = tetrahedron(needle_corners);
  condyle_mesh* plane = box(plane_low, plane_high);
  condyle_mesh* block = box(block_low, block_high);
  turn(wall, needle, &start);
  penetrate(wall, needle, &turned);
  press(plane, block, &lowered);
  condyle_mesh_destroy(block);
  condyle_mesh_destroy(plane);
  condyle_mesh_destroy(needle);
  condyle_mesh_destroy(wall);
  return EXIT_SUCCESS;
}
