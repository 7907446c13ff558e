/* A ball that is let go on an elastic layer, where it overlaps at first, comes to rest, and then grows. Where it rests has a closed
 * form. In C99:
 *
 *     cc -std=c99 falling_ball.c $(pkg-config --cflags --libs condyle-c) -lm -o falling_ball
 */
#include <condyle/condyle.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum {
  RINGS = 100, /* of the ball, from pole to pole */
  AROUND = 40, /* vertices of a ring */
  BALL_VERTICES = (RINGS - 1) * AROUND + 2,
  BALL_TRIANGLES = 2 * (RINGS - 1) * AROUND,
  CELLS = 32, /* of the layer, along a side */
  LAYER_VERTICES = (CELLS + 1) * (CELLS + 1),
  LAYER_TRIANGLES = 2 * CELLS * CELLS
};

/* N, mm and s: a mass of 1 kg is 0.001 N s2 / mm. */
static const double mass = 0.001, weight_n = 9.81, step_s = 0.0005;

/* What it needs for a step, made once. */
typedef struct falling_ball {
  condyle_elastic_contact* contact;
  condyle_force_options* options;
  condyle_force_results* results;
  condyle_ramp* ramp;
  double time_s, height_mm, velocity_mm_s;
  condyle_force_load load;
} falling_ball;

/* Ends the program with the library's line. */
static void check(condyle_status status) {
  if (status == CONDYLE_OK) return;
  fprintf(stderr, "falling_ball: %s\n", condyle_last_error());
  exit(EXIT_FAILURE);
}

static void set(uint32_t* triangle, unsigned a, unsigned b, unsigned c) {
  triangle[0] = a, triangle[1] = b, triangle[2] = c;
}

/* Rings from the lower pole, vertex 0, to the upper one, the last. */
static void ball_vertices(double radius_mm, double* xyz) {
  const double pi = acos(-1.0);
  for (int v = 0; v < BALL_VERTICES; ++v) {
    const int ring = v == 0 ? 0 : (v - 1) / AROUND + 1, place = v == 0 ? 0 : (v - 1) % AROUND;
    const double polar = pi * ring / RINGS, around = 2 * pi * place / AROUND;
    xyz[3 * v] = radius_mm * sin(polar) * cos(around);
    xyz[3 * v + 1] = radius_mm * sin(polar) * sin(around);
    xyz[3 * v + 2] = -radius_mm * cos(polar);
  }
}

static condyle_mesh* ball(double radius_mm) {
  static double xyz[3 * BALL_VERTICES];
  static uint32_t triangles[3 * BALL_TRIANGLES];
  uint32_t* next = triangles;
  condyle_mesh* mesh;
  ball_vertices(radius_mm, xyz);
  for (unsigned i = 0; i < AROUND; ++i) {
    const unsigned k = (i + 1) % AROUND;
    const unsigned top = (RINGS - 2) * AROUND + 1;
    set(next, 0, 1 + k, 1 + i), next += 3;
    set(next, top + i, top + k, BALL_VERTICES - 1), next += 3;
    for (unsigned ring = 0; ring < RINGS - 2; ++ring) {
      const unsigned low = ring * AROUND + 1, high = low + AROUND;
      set(next, low + i, low + k, high + k), next += 3;
      set(next, low + i, high + k, high + i), next += 3;
    }
  }
  check(condyle_mesh_create(xyz, BALL_VERTICES, triangles, BALL_TRIANGLES, &mesh));
  return mesh;
}

/* A square sheet at z = 0 that faces upwards: surfaces with a layer may be open. */
static condyle_mesh* sheet(double half_mm) {
  static double xyz[3 * LAYER_VERTICES];
  static uint32_t triangles[3 * LAYER_TRIANGLES];
  uint32_t* next = triangles;
  condyle_mesh* mesh;
  for (int v = 0; v < LAYER_VERTICES; ++v) {
    xyz[3 * v] = half_mm * (2.0 * (v % (CELLS + 1)) / CELLS - 1);
    xyz[3 * v + 1] = half_mm * (2.0 * (v / (CELLS + 1)) / CELLS - 1);
    xyz[3 * v + 2] = 0;
  }
  for (unsigned i = 0; i < CELLS; ++i)
    for (unsigned k = 0; k < CELLS; ++k) {
      const unsigned v = i * (CELLS + 1) + k;
      set(next, v, v + 1, v + CELLS + 2), next += 3;
      set(next, v, v + CELLS + 2, v + CELLS + 1), next += 3;
    }
  check(condyle_mesh_create(xyz, LAYER_VERTICES, triangles, LAYER_TRIANGLES, &mesh));
  return mesh;
}

static condyle_elastic_contact* ball_on_layer(double radius_mm) {
  const double thickness_mm = 2;
  condyle_mesh* fixed = sheet(4);
  condyle_mesh* mobile = ball(radius_mm);
  condyle_elastic_options* options;
  condyle_elastic_contact* contact;
  check(condyle_elastic_options_create(&options));
  check(condyle_elastic_options_set_casting(options, CONDYLE_CAST_FIXED));
  check(condyle_elastic_options_set_layer(options, CONDYLE_FIXED, 10, 0.25, &thickness_mm, 1));
  check(condyle_elastic_contact_create(fixed, mobile, options, &contact));
  condyle_elastic_options_destroy(options);
  condyle_mesh_destroy(mobile);
  condyle_mesh_destroy(fixed);
  return contact;
}

static condyle_pose pose_at(double height_mm) {
  const condyle_pose X_FM = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, height_mm}};
  return X_FM;
}

/* One step of semi-implicit Euler along z. */
static void step(falling_ball* of) {
  static const double still[3] = {0, 0, 0};
  const condyle_pose X_FM = pose_at(of->height_mm);
  double velocity[3] = {0, 0, 0};
  velocity[2] = of->velocity_mm_s;
  check(condyle_force_options_set_motion(of->options, velocity, still));
  check(condyle_force_options_set_factor(of->options, condyle_ramp_factor_at(of->ramp, of->time_s)));
  check(condyle_elastic_contact_forces(of->contact, &X_FM, of->options, of->results));
  check(condyle_force_results_load(of->results, &of->load));
  of->velocity_mm_s += step_s * (of->load.on_mobile.force_n[2] - weight_n) / mass;
  of->height_mm += step_s * of->velocity_mm_s;
  of->time_s += step_s;
}

int main(void) {
  static double xyz[3 * BALL_VERTICES];
  const double radius_mm = 10, larger_mm = 11.2, start_mm = 9.5;
  const condyle_pose start = pose_at(start_mm);
  falling_ball on = {NULL, NULL, NULL, NULL, 0, 0, 0, {{{0, 0, 0}, {0, 0, 0}}, 0, 0, 0, 0, 0}};
  double stiffness[36];
  on.contact = ball_on_layer(radius_mm);
  on.height_mm = start_mm;
  check(condyle_force_options_create(&on.options));
  check(condyle_force_options_set_damping(on.options, 0.1));
  check(condyle_force_results_create(&on.results)); /* one for all steps: it keeps its memory */
  /* Let go at once, the ball would be thrown off by what 0.5 mm store. */
  check(condyle_ramp_create(on.contact, &start, 0.02, &on.ramp));
  printf("starts %.2f mm deep\n", condyle_ramp_max_depth_mm(on.ramp));
  for (int i = 0; i < 400; ++i) step(&on);
  /* 6 MPa / mm, 12 MPa on 2 mm, times the volume of the cap that overlaps, pi d2 (R - d / 3): 9.81 N at d = 0.229 mm. */
  printf("carries %.2f N at %.2f mm\n", on.load.on_mobile.force_n[2], radius_mm - on.height_mm);
  for (int i = 1; i <= 100; ++i) {
    ball_vertices(radius_mm + (larger_mm - radius_mm) * i / 100, xyz);
    check(condyle_elastic_contact_update(on.contact, CONDYLE_MOBILE, xyz, BALL_VERTICES));
    step(&on);
  }
  check(condyle_force_options_set_parts(on.options, CONDYLE_STIFFNESS));
  for (int i = 0; i < 300; ++i) step(&on);
  check(condyle_force_results_stiffness(on.results, stiffness));
  /* Now at 0.216 mm, where it takes 6 MPa / mm times the area of the circle, pi d (2 R - d): 90.4 N / mm. */
  printf("grown, carries %.2f N at %.2f mm, with %.0f N/mm\n", on.load.on_mobile.force_n[2],
         larger_mm - on.height_mm, stiffness[14]);
  condyle_ramp_destroy(on.ramp);
  condyle_force_results_destroy(on.results);
  condyle_force_options_destroy(on.options);
  condyle_elastic_contact_destroy(on.contact);
  return EXIT_SUCCESS;
}
