/* Force laws of your own in a shared library: what such a library and hydrodae agree on. This file
   needs nothing else; copy it beside your source. C, and C++ as well.

     static void brake(double t, const double* x, const double* v, const double* z,
                       const double* parameters, double* load, double* z_dot) {
       load[0] = -parameters[0] * v[0] * fabs(v[0]);
     }
     static const char* const names[] = {"drag"};
     static const hydrodae_law laws[] = {{"brake", 0, 1, names, 0, 0, brake, 0}};
     HYDRODAE_PLUGIN(laws)

   cc -O2 -shared -fPIC brake.c -o brake.so
   hydrodae-solve case.toml -o results.h5 --library ./brake.so */
#ifndef HYDRODAE_PLUGIN_H
#define HYDRODAE_PLUGIN_H

#define HYDRODAE_PLUGIN_VERSION 1

#ifdef __cplusplus
extern "C" {
#endif

/* A state z of a law. */
typedef struct {
  const char* name;
  const char* unit;
  double scale; /* what one unit of tolerance means, above 0 */
  double start;
} hydrodae_state;

typedef struct {
  const char* name;              /* `law = "..."` of a case */
  int on_body;                   /* 0: along the coordinate of a joint, 1: on a body */
  int n_parameters;              /* numbers that the case gives */
  const char* const* parameters; /* their names, for messages */
  int n_states;
  const hydrodae_state* states;

  /* Of the arguments alone, smooth, and without exceptions: called several times a step.
       t           time [s]
       x, v        along a joint: coordinate [m or rad] and rate (1 each); on a body: displacement
                   from the reference pose (translation [m], rotation vector [rad]) and twist
                   [m/s, rad/s] in earth axes (6 each)
       z           states (n_states)
       load        along a joint [N or N m] (1); on a body force and moment about the centre of
                   gravity [N, N m], earth axes (6)
       z_dot       rates of the states [1/s] (n_states) */
  void (*evaluate)(double t, const double* x, const double* v, const double* z,
                   const double* parameters, double* load, double* z_dot);

  /* Derivatives of (load, z_dot) by (x, v, z), column by column; or null: by differences. */
  void (*jacobian)(double t, const double* x, const double* v, const double* z,
                   const double* parameters, double* derivatives);
} hydrodae_law;

/* What a library exports. */
typedef struct {
  int version;
  int n_laws;
  const hydrodae_law* laws;
} hydrodae_plugin;

#ifdef __cplusplus
}
#define HYDRODAE_EXPORT extern "C" __attribute__((visibility("default")))
#else
#define HYDRODAE_EXPORT __attribute__((visibility("default")))
#endif

#define HYDRODAE_PLUGIN(array)                                                                     \
  HYDRODAE_EXPORT const hydrodae_plugin* hydrodae_get_plugin(void) {                               \
    static const hydrodae_plugin plugin = {HYDRODAE_PLUGIN_VERSION,                                \
                                           (int)(sizeof(array) / sizeof(array[0])), array};        \
    return &plugin;                                                                                \
  }

#endif
