/* SPDX-License-Identifier: Apache-2.0 */
/* What the headers of `quadrance registers` share: an arm, and how words follow from it. C99 or C++11; needs <math.h>. */
#ifndef QUADRANCE_H
#define QUADRANCE_H
#include <math.h>
#include <stdint.h>

#define QUADRANCE_PI 3.14159265358979323846

/* An arm as its file has it: millimetres and degrees. What a core does not use may be 0. */
typedef struct {
    double mm_per_unit;
    double l1, l2, l3;                        /* links */
    double base, shoulder, lateral, elbow;    /* constants */
    double flange, offset;                    /* wrist */
    double singular_elbow, singular_axis;     /* singular */
    double shoulder_limit[2], elbow_limit[2], yaw_limit[2], forearm_limit[2];
} quadrance_arm;

/* whether an arm file might say it; false of what is no number */
static inline int quadrance_sound(const quadrance_arm *arm) {
    return arm->mm_per_unit > 0 && arm->mm_per_unit <= 1e9 && arm->l1 >= 0 && arm->l1 <= 1e9 && arm->l2 >= 0
        && arm->l2 <= 1e9;
}

/* a whole number as a word; one that no word holds, or none at all, is 2^40, which fits no core */
static inline int64_t quadrance_word(double whole) {
    return fabs(whole) < ldexp(1.0, 40) ? (int64_t)whole : (int64_t)1 << 40;
}

/* the nearest word, ties upward */
static inline int64_t quadrance_fixed(double value, int fraction) {
    return quadrance_word(floor(value * ldexp(1.0, fraction) + 0.5));
}

static inline int64_t quadrance_length(const quadrance_arm *arm, double mm, int fraction) {
    return quadrance_fixed(mm / arm->mm_per_unit, fraction);
}

/* from the elbow to the end of link 2; along the forearm */
static inline double quadrance_line(const quadrance_arm *arm) {
    return arm->elbow != 0 ? hypot(arm->l2, arm->elbow) : arm->l2;
}

static inline double quadrance_forearm(const quadrance_arm *arm) {
    double line = quadrance_line(arm);
    return sqrt(line * line - arm->elbow * arm->elbow);
}

/* between the line and the forearm, degrees */
static inline double quadrance_elbow_angle(const quadrance_arm *arm) {
    return atan2(arm->elbow, arm->l2) * (180.0 / QUADRANCE_PI);
}

static inline double quadrance_radians(double degrees) { return degrees * (QUADRANCE_PI / 180.0); }

/* Binary angle, a full turn is 2^a */
static inline uint32_t quadrance_angle(double degrees, int a) {
    double turns = degrees / 360.0;
    return (uint32_t)((uint64_t)quadrance_fixed(turns - floor(turns), a) & ((UINT64_C(1) << a) - 1));
}

static inline double quadrance_angle_degrees(uint32_t word, int a) {
    return ldexp((double)word, -a) * 360.0;
}

/* Turn-spread, 2 + s bits */
static inline uint32_t quadrance_spread(double degrees, int s) {
    double quarters = degrees / 90.0 - 4.0 * floor(degrees / 360.0), quadrant = floor(quarters);
    double sine = sin((quarters - quadrant) * (QUADRANCE_PI / 2));
    return (uint32_t)((uint64_t)quadrance_fixed(quadrant + sine * sine, s) & ((UINT64_C(4) << s) - 1));
}

static inline double quadrance_spread_degrees(uint32_t word, int s) {
    double quarters = ldexp((double)word, -s), quadrant = floor(quarters), part = quarters - quadrant;
    return 90.0 * quadrant + atan2(sqrt(part), sqrt(1 - part)) * (180.0 / QUADRANCE_PI);
}

/* Unit vector, u fraction bits */
static inline void quadrance_vector(double degrees, int u, int32_t *c, int32_t *n) {
    double theta = quadrance_radians(degrees - 360.0 * floor(degrees / 360.0));
    *c = (int32_t)quadrance_fixed(cos(theta), u);
    *n = (int32_t)quadrance_fixed(sin(theta), u);
}

static inline double quadrance_vector_degrees(int32_t c, int32_t n) {
    double theta = atan2((double)n, (double)c) * (180.0 / QUADRANCE_PI);
    return theta < 0 ? theta + 360.0 : theta;
}

/* cfg_q, cfg_r, cfg_e of the inverse cores, from the words of both links */
typedef struct { int64_t q, r, e; } quadrance_gap;

static inline quadrance_gap quadrance_gap_of(int w, int64_t l1, int64_t l2) {
    quadrance_gap found;
    int n = w > 20 ? 24 : w > 16 ? 20 : 16, fraction = n == 24 ? 29 : 25, drop = 2 * n - fraction, bits = 0, e, i;
    uint64_t twice, half, rest = 0;
    if (l1 < 0 || l2 < 0 || l1 >> w || l2 >> w) {
        found.q = found.r = found.e = (int64_t)1 << 60;
        return found;
    }
    l1 *= (int64_t)1 << (n - w);
    l2 *= (int64_t)1 << (n - w);
    twice = 2 * (uint64_t)l1 * (uint64_t)l2;
    while (bits < 63 && twice >> bits) ++bits;
    e = bits > 2 * n + 1 ? 0 : (2 * n + 1 - bits) / 2;
    if (e > n - 1) e = n - 1;
    half = 2 * e < drop ? UINT64_C(1) << (drop - 1 - 2 * e) : 0;
    found.q = (int64_t)half - l1 * l1 - l2 * l2 + (l1 == 0 && l2 == 0);
    twice = twice + half ? twice + half : 1;
    found.r = 0; /* 2^i - 1 by twice, bit by bit: it may be longer than 64 */
    for (i = 2 * fraction - 1 + drop - 2 * e; i > 0; --i) {
        rest = 2 * rest + 1;
        found.r = 2 * found.r + (rest >= twice);
        if (rest >= twice) rest -= twice;
    }
    found.e = e;
    return found;
}

/* cfg_f of classic_ik2 and classic_ik3 */
static inline int64_t quadrance_tangent(int w, int64_t l1, int64_t l2) {
    int64_t sum = l1 + l2 > 0 ? l1 + l2 : 1, wide = (l2 - l1) * ((int64_t)1 << (w + 2)), whole = wide / sum;
    return whole - (wide % sum < 0);
}

static inline int64_t quadrance_square(int64_t value) {
    return value < -INT64_C(0x7fffffff) || value > INT64_C(0x7fffffff) ? (int64_t)1 << 62 : value * value;
}

static inline int64_t quadrance_least(int64_t a, int64_t b) { return a < b ? a : b; }

/* cfg_mc, cfg_mn, cfg_h of the limits of a joint */
typedef struct { int64_t mc, mn, h; } quadrance_limit;

static inline quadrance_limit quadrance_limit_of(double low, double high, double less, int u) {
    double one = ldexp(1.0, u), first = quadrance_radians(low - less), last = quadrance_radians(high - less);
    double middle = (first + last) / 2, room = (last - first) / 2;
    quadrance_limit found;
    found.mc = quadrance_word(rint(cos(middle) * one));
    found.mn = quadrance_word(rint(sin(middle) * one));
    found.h = room >= QUADRANCE_PI ? (int64_t)(-2 * one) : quadrance_word(floor(cos(room) * one)) - 3;
    return found;
}

/* cfg_r, cfg_e of six and seven axes, from the words of both links; 1.0 is `one` */
typedef struct { int64_t r, e; } quadrance_triangle;

static inline quadrance_triangle quadrance_triangle_of(int w, int more, double one, int64_t l1, int64_t l2) {
    double twice = fmax(2.0 * (double)l1 * (double)l2 * ldexp(1.0, -2 * w - 2 * more), ldexp(1.0, -20));
    int e = twice < 1 ? (int)floor(-log2(twice)) + 1 : 1;
    quadrance_triangle found;
    if (e < 1) e = 1;
    found.r = quadrance_least(quadrance_word(floor(one / twice / ldexp(1.0, e))), (int64_t)one - 1);
    found.e = (int64_t)1 << e;
    return found;
}

/* further words of the cores of a spherical wrist */
typedef struct { int64_t k, cp, np, r, e; } quadrance_six;

static inline int64_t quadrance_fine(const quadrance_arm *arm, double mm, int fraction) {
    return quadrance_word(rint(mm / arm->mm_per_unit * ldexp(1.0, fraction)));
}

static inline quadrance_six quadrance_six_of(const quadrance_arm *arm, int w, int fraction, int more, double one) {
    double a2 = -arm->elbow / arm->mm_per_unit, c3 = quadrance_forearm(arm) / arm->mm_per_unit, psi = atan2(a2, c3);
    quadrance_triangle triangle;
    quadrance_six found;
    found.k = quadrance_word(rint(hypot(a2, c3) * ldexp(1.0, fraction)));
    triangle = quadrance_triangle_of(w, more, one, quadrance_fine(arm, arm->l1, fraction), found.k);
    found.cp = quadrance_word(rint(one * cos(psi)));
    found.np = quadrance_word(rint(one * sin(psi)));
    found.r = triangle.r;
    found.e = triangle.e;
    return found;
}

/* A frame seen from another: its rotation by rows, its place in mm */
typedef struct { double r[3][3], p[3]; } quadrance_frame;

/* turned about the other's x, y and z, one after the other, degrees */
static inline quadrance_frame quadrance_frame_of(double x, double y, double z, double roll, double pitch, double yaw) {
    double a = quadrance_radians(roll), b = quadrance_radians(pitch), c = quadrance_radians(yaw);
    quadrance_frame found;
    found.r[0][0] = cos(c) * cos(b); found.r[0][1] = cos(c) * sin(b) * sin(a) - sin(c) * cos(a);
    found.r[0][2] = cos(c) * sin(b) * cos(a) + sin(c) * sin(a);
    found.r[1][0] = sin(c) * cos(b); found.r[1][1] = sin(c) * sin(b) * sin(a) + cos(c) * cos(a);
    found.r[1][2] = sin(c) * sin(b) * cos(a) - cos(c) * sin(a);
    found.r[2][0] = -sin(b); found.r[2][1] = cos(b) * sin(a); found.r[2][2] = cos(b) * cos(a);
    found.p[0] = x; found.p[1] = y; found.p[2] = z;
    return found;
}

static inline quadrance_frame quadrance_times(const quadrance_frame *a, const quadrance_frame *b) {
    quadrance_frame found;
    int i, j, k;
    for (i = 0; i < 3; ++i) {
        found.p[i] = a->p[i];
        for (j = 0; j < 3; ++j) {
            found.p[i] += a->r[i][j] * b->p[j];
            for (found.r[i][j] = 0, k = 0; k < 3; ++k) found.r[i][j] += a->r[i][k] * b->r[k][j];
        }
    }
    return found;
}

static inline quadrance_frame quadrance_inverse(const quadrance_frame *a) {
    quadrance_frame found;
    int i, j;
    for (i = 0; i < 3; ++i)
        for (found.p[i] = 0, j = 0; j < 3; ++j) {
            found.r[i][j] = a->r[j][i];
            found.p[i] -= a->r[j][i] * a->p[j];
        }
    return found;
}

/* words of in_r11, in_r12 ... in_r33, in_x, in_y, in_z; -1 where one does not fit, and they stay as they were */
static inline int quadrance_pose(int32_t words[12], const quadrance_frame *own, double mm_per_unit, int u, int w,
                                 int f) {
    double found[12];
    int i;
    for (i = 0; i < 12; ++i) {
        found[i] = i < 9 ? rint(ldexp(own->r[i / 3][i % 3], u)) : rint(ldexp(own->p[i - 9] / mm_per_unit, f));
        if (!(found[i] >= -ldexp(1.0, i < 9 ? u + 1 : w - 1) && found[i] < ldexp(1.0, i < 9 ? u + 1 : w - 1)))
            return -1;
    }
    for (i = 0; i < 12; ++i) words[i] = (int32_t)found[i];
    return 0;
}

static inline int quadrance_fits(int64_t value, int64_t low, int64_t high) { return low <= value && value <= high; }

#endif
