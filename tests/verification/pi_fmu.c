/* A PI controller of a rate as an FMU for co-simulation; FMI = 2 or 3.
 *
 *   load = kp (-rate) + integral,   integral += h ki (-rate) at each step
 *
 * Variables by reference: 1 rate (input), 2 load (output), 3 kp, 4 ki, 5 discard_at, 6 fail_at,
 * 7 end_at (parameters; the times at which a step is not made [s]), 8 trick (parameter; what it
 * does wrong from 1 s on: 1 answers NaN, 2 ends in a status that there is not, 3 ends in Fatal,
 * 4 logs bytes that are no text, 5 claims a state without end). Names and types are those of the
 * standard (fmi-standard.org). */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define API __attribute__((visibility("default")))
enum { OK, WARNING, DISCARD, ERROR, FATAL };
enum { NO_NUMBER = 1, NO_STATUS, DIES, NO_TEXT, NO_END };

typedef struct {
  double values[9], integral, time;
} State;

typedef struct {
  State s;
#if FMI == 2
  void (*log)(void*, const char*, int, const char*, const char*, ...);
#else
  void (*log)(void*, int, const char*, const char*);
#endif
  void* environment;
  bool ended;
} Pi;

static int tell(Pi* p, int status, const char* text) {
#if FMI == 2
  p->log(p->environment, "pi", status, "pi", "%s, %d", text, status);
#else
  p->log(p->environment, status, "pi", text);
#endif
  return status;
}

static void start(Pi* p) {
  const State zero = {{0.0, 0.0, 0.0, 0.0, 0.0, INFINITY, INFINITY, INFINITY, 0.0}, 0.0, 0.0};
  p->s = zero;
  p->ended = false;
}

static bool tricks(const Pi* p, int trick) { return p->s.time >= 1.0 && p->s.values[8] == trick; }

static size_t size_of(const Pi* p) {
  return p->s.values[8] == NO_END ? SIZE_MAX / 2 : sizeof(State);
}

static int get(Pi* p, const unsigned* r, size_t n, double* out) {
  p->s.values[2] = p->s.values[3] * -p->s.values[1] + p->s.integral;
  for (size_t k = 0; k < n; ++k)
    out[k] = tricks(p, NO_NUMBER) ? NAN : p->s.values[r[k]];
  return OK;
}

static int set(Pi* p, const unsigned* r, size_t n, const double* in) {
  for (size_t k = 0; k < n; ++k) {
    if (r[k] == 3 && in[k] < 0.0)
      return tell(p, ERROR, "kp is negative");
    p->s.values[r[k]] = in[k];
  }
  return OK;
}

static int step(Pi* p, double t, double h) {
  if (fabs(t - p->s.time) > 1e-9)
    return tell(p, ERROR, "a step from another time than that of the last");
  if (tricks(p, NO_STATUS))
    return 42;
  if (tricks(p, DIES))
    return tell(p, FATAL, "it is no more");
  if (tricks(p, NO_TEXT))
    return tell(p, ERROR, "bad \xff\xfe\xc3 bytes\x01");
  if (t + h > p->s.values[6])
    return tell(p, ERROR, "it fails");
  if (t + h > p->s.values[7]) {
    p->ended = true;
    return FMI == 2 ? DISCARD : OK;
  }
  if (t + h > p->s.values[5])
    return tell(p, DISCARD, "the step is too long");
  p->s.integral += h * (p->s.values[4] * -p->s.values[1]);
  p->s.time = t + h;
  return OK;
}

static int save(Pi* p, void** state) {
  if (!*state)
    *state = malloc(sizeof(State));
  memcpy(*state, &p->s, sizeof(State));
  return OK;
}

#if FMI == 2
typedef struct {
  void (*logger)(void*, const char*, int, const char*, const char*, ...);
  void* (*allocate)(size_t, size_t);
  void (*release)(void*);
  void (*finished)(void*, int);
  void* environment;
} Callbacks;

API void* fmi2Instantiate(const char* name, int type, const char* guid, const char* resources,
                          const Callbacks* callbacks, int visible, int logging) {
  (void)name, (void)resources, (void)visible, (void)logging;
  if (type != 1 || strcmp(guid, "token-of-pi") != 0)
    return NULL;
  Pi* p = callbacks->allocate(1, sizeof(Pi));
  start(p);
  p->log = callbacks->logger;
  p->environment = callbacks->environment;
  return p;
}
API void fmi2FreeInstance(void* p) { free(p); }
API int fmi2SetupExperiment(void* p, int tolerance, double t, double begin, int stops, double end) {
  (void)tolerance, (void)t, (void)stops, (void)end;
  ((Pi*)p)->s.time = begin;
  return OK;
}
API int fmi2EnterInitializationMode(void* p) { return (void)p, OK; }
API int fmi2ExitInitializationMode(void* p) { return (void)p, OK; }
API int fmi2Terminate(void* p) { return (void)p, OK; }
API int fmi2Reset(void* p) { return start(p), OK; }
API int fmi2GetReal(void* p, const unsigned* r, size_t n, double* out) { return get(p, r, n, out); }
API int fmi2SetReal(void* p, const unsigned* r, size_t n, const double* in) {
  return set(p, r, n, in);
}
API int fmi2DoStep(void* p, double t, double h, int keep) { return (void)keep, step(p, t, h); }
API int fmi2GetBooleanStatus(void* p, int kind, int* value) {
  *value = kind == 3 && ((Pi*)p)->ended;
  return OK;
}
API int fmi2GetFMUstate(void* p, void** state) { return save(p, state); }
API int fmi2SetFMUstate(void* p, void* state) { return ((Pi*)p)->s = *(State*)state, OK; }
API int fmi2FreeFMUstate(void* p, void** state) { return (void)p, free(*state), *state = NULL, OK; }
API int fmi2SerializedFMUstateSize(void* p, void* state, size_t* size) {
  return (void)state, *size = size_of(p), OK;
}
API int fmi2SerializeFMUstate(void* p, void* state, char* out, size_t size) {
  return (void)p, memcpy(out, state, size), OK;
}
API int fmi2DeSerializeFMUstate(void* p, const char* bytes, size_t size, void** state) {
  return (void)p, *state = malloc(size), memcpy(*state, bytes, size), OK;
}
#else
API void* fmi3InstantiateCoSimulation(const char* name, const char* token, const char* resources,
                                      bool visible, bool logging, bool events, bool early,
                                      const uint32_t* needed, size_t n_needed, void* environment,
                                      void (*log)(void*, int, const char*, const char*),
                                      void* update) {
  (void)name, (void)resources, (void)visible, (void)logging, (void)early, (void)needed;
  if (events || n_needed > 0 || update || strcmp(token, "token-of-pi") != 0)
    return NULL;
  Pi* p = malloc(sizeof(Pi));
  start(p);
  p->log = log;
  p->environment = environment;
  return p;
}
API void fmi3FreeInstance(void* p) { free(p); }
API int fmi3EnterInitializationMode(void* p, bool tolerance, double t, double begin, bool stops,
                                    double end) {
  (void)tolerance, (void)t, (void)stops, (void)end;
  ((Pi*)p)->s.time = begin;
  return OK;
}
API int fmi3ExitInitializationMode(void* p) { return (void)p, OK; }
API int fmi3Terminate(void* p) { return (void)p, OK; }
API int fmi3Reset(void* p) { return start(p), OK; }
API int fmi3GetFloat64(void* p, const uint32_t* r, size_t n, double* out, size_t m) {
  return n == m ? get(p, r, n, out) : ERROR;
}
API int fmi3SetFloat64(void* p, const uint32_t* r, size_t n, const double* in, size_t m) {
  return n == m ? set(p, r, n, in) : ERROR;
}
API int fmi3DoStep(void* p, double t, double h, bool keep, bool* event, bool* ends, bool* early,
                   double* last) {
  (void)keep;
  const int status = step(p, t, h);
  *event = *early = false;
  *ends = ((Pi*)p)->ended;
  *last = ((Pi*)p)->s.time;
  return status;
}
API int fmi3GetFMUState(void* p, void** state) { return save(p, state); }
API int fmi3SetFMUState(void* p, void* state) { return ((Pi*)p)->s = *(State*)state, OK; }
API int fmi3FreeFMUState(void* p, void** state) { return (void)p, free(*state), *state = NULL, OK; }
API int fmi3SerializedFMUStateSize(void* p, void* state, size_t* size) {
  return (void)state, *size = size_of(p), OK;
}
API int fmi3SerializeFMUState(void* p, void* state, uint8_t* out, size_t size) {
  return (void)p, memcpy(out, state, size), OK;
}
API int fmi3DeserializeFMUState(void* p, const uint8_t* bytes, size_t size, void** state) {
  return (void)p, *state = malloc(size), memcpy(*state, bytes, size), OK;
}
#endif
