/* Variables of all kinds in an FMU for co-simulation; FMI = 2 or 3. Values stand in one row of
 * numbers, whatever their types are:
 *
 *   inputs      1 rate (number), 2 gear (integer), 3 on (boolean)
 *   parameters  4 mode (enumeration), 5 invert (boolean), 6 least (8 bits), 7 label (string)
 *   outputs     8 brake (boolean): on and rate < 0, or > 0 where inverted
 *               9 steps (16 bits), 10 length (64 bits): of the label, times the gear; at mode 9 2^60
 *               11 phase (enumeration): the mode; 12 half (32 bits): half the rate
 *
 * Names and types are those of the standard (fmi-standard.org). */
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define API __attribute__((visibility("default")))
enum { OK, ERROR = 3 };

typedef struct {
  double v[13];
  char label[32];
} Kinds;

static void answer(Kinds* p) {
  double* v = p->v;
  v[8] = v[3] != 0.0 && (v[5] != 0.0 ? v[1] > 0.0 : v[1] < 0.0);
  v[10] = v[4] == 9.0 ? 1152921504606846976.0 : (double)strlen(p->label) * v[2];
  v[11] = v[4];
  v[12] = 0.5 * v[1];
}

#define VALUES_OF(VERSION, NAME, T, COUNT)                                                         \
  API int fmi##VERSION##Get##NAME(void* p, const unsigned* r, size_t n, T* out COUNT) {            \
    answer(p);                                                                                     \
    for (size_t k = 0; k < n; ++k)                                                                 \
      out[k] = (T)((Kinds*)p)->v[r[k]];                                                            \
    return OK;                                                                                     \
  }                                                                                                \
  API int fmi##VERSION##Set##NAME(void* p, const unsigned* r, size_t n, const T* in COUNT) {       \
    for (size_t k = 0; k < n; ++k)                                                                 \
      ((Kinds*)p)->v[r[k]] = (double)in[k];                                                        \
    return OK;                                                                                     \
  }

static int set_label(Kinds* p, const unsigned* r, size_t n, const char* const* in) {
  if (n != 1 || r[0] != 7)
    return ERROR;
  snprintf(p->label, sizeof p->label, "%s", in[0]);
  return OK;
}
static int step(Kinds* p) { return ++p->v[9], OK; }

#if FMI == 2
VALUES_OF(2, Real, double, )
VALUES_OF(2, Integer, int, )
VALUES_OF(2, Boolean, int, )
API int fmi2SetString(void* p, const unsigned* r, size_t n, const char* const* in) {
  return set_label(p, r, n, in);
}
API void* fmi2Instantiate(void) { return calloc(1, sizeof(Kinds)); }
API void fmi2FreeInstance(void* p) { free(p); }
API int fmi2SetupExperiment(void) { return OK; }
API int fmi2EnterInitializationMode(void) { return OK; }
API int fmi2ExitInitializationMode(void) { return OK; }
API int fmi2Terminate(void) { return OK; }
API int fmi2Reset(void* p) { return memset(p, 0, sizeof(Kinds)), OK; }
API int fmi2DoStep(void* p) { return step(p); }
API int fmi2GetBooleanStatus(void) { return ERROR; }
#else
#define M , size_t m
VALUES_OF(3, Float64, double, M)
VALUES_OF(3, Float32, float, M)
VALUES_OF(3, Int8, int8_t, M)
VALUES_OF(3, UInt16, uint16_t, M)
VALUES_OF(3, Int32, int32_t, M)
VALUES_OF(3, Int64, int64_t, M)
VALUES_OF(3, Boolean, bool, M)
API int fmi3SetString(void* p, const unsigned* r, size_t n, const char* const* in M) {
  return m == n ? set_label(p, r, n, in) : ERROR;
}
API void* fmi3InstantiateCoSimulation(void) { return calloc(1, sizeof(Kinds)); }
API void fmi3FreeInstance(void* p) { free(p); }
API int fmi3EnterInitializationMode(void) { return OK; }
API int fmi3ExitInitializationMode(void) { return OK; }
API int fmi3Terminate(void) { return OK; }
API int fmi3Reset(void* p) { return memset(p, 0, sizeof(Kinds)), OK; }
API int fmi3DoStep(void* p, double t, double h, bool keep, bool* event, bool* ends, bool* early,
                   double* last) {
  (void)keep;
  *event = *ends = *early = false;
  *last = t + h;
  return step(p);
}
#endif
