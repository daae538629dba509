/* SPDX-License-Identifier: Apache-2.0
 * The kinematics that docs/why-not-c.md measures, as float or with -DFIXED in 32-bit integers; ci/whynot.py compiles it
 * with the arm as -D constants. Lengths are in units of 256 coordinate units, so both forms compute with numbers below 2.
 * Fixed point: outside the words of the cores (coordinates Q7.8, unit vectors s2.16, angles of 18 bits: every word has
 * its last bit at 2^-16, 2^-18 of a turn), inside Q30, squares Q60 where a root or a direction follows.
 * A function returns 1 for unreachable, 2 for a joint without direction, which then is (1, 0).
 */
#define _POSIX_C_SOURCE 199309L
#include <stdint.h>

#define PI_2 1.57079632679
#define IN static inline __attribute__((always_inline))

#ifdef FIXED
typedef int32_t num;
typedef int64_t wide;
#define C(x) ((num)((x) * 1073741824.0 + ((x) < 0 ? -0.5 : 0.5)))
#define WIDE(x) ((wide)((x) * 1152921504606846976.0))
#define FACTOR(x) ((num)((x) * 16777216.0))             /* a constant of up to 127 */
typedef uint32_t turn;                                  /* an angle, a turn is 2^32 */

IN num get(num word) { return (num)((uint32_t)word << 14); }
IN num put(num x) { return (x + (1 << 13)) >> 14; }
IN turn get_turn(num word) { return (turn)word << 14; }
IN num put_turn(turn a) { return (num)((a + (1 << 13)) >> 14 & 0x3ffff); }
IN num mul(num a, num b) { return (num)((int64_t)a * b >> 32) * 4; }
IN num times(num a, num factor) {
    int64_t p = (int64_t)a * factor >> 24;
    return p > INT32_MAX ? INT32_MAX : p < -INT32_MAX ? -INT32_MAX : (num)p;
}
IN wide dot(num a, num b, num c, num d) { return (int64_t)a * b + (int64_t)c * d; }
IN wide beside(num c) { return WIDE(1) - (int64_t)c * c; }                  /* 1 - c^2 */
IN num narrow(wide v) { return (num)(v >> 30); }
IN uint32_t high(uint32_t a, uint32_t b) { return (uint32_t)((uint64_t)a * b >> 32); }

static uint32_t knots[225];                             /* Q27: 1/sqrt(i/128), i = 32 to 256 */
void start(void) {
    for (uint32_t i = 32; i <= 256; i++) {
        uint64_t rest = ((uint64_t)1 << 61) / i, root = 0;
        for (uint64_t bit = (uint64_t)1 << 30; bit; bit >>= 1)
            if ((root + bit) * (root + bit) <= rest) root += bit;
        knots[i - 32] = (uint32_t)root;
    }
}
/* 1/sqrt(q) in Q29, q Q30 in [1/4, 2): a line between two knots, and one Newton step */
IN uint32_t rsqrt(uint32_t q) {
    const uint32_t *k = knots + ((q >> 23) - 32);
    uint32_t y = (k[0] - high(k[0] - k[1], q << 9)) << 3;
    uint32_t one = high(q << 1, high(y, y) << 1);
    return high(y, ((3u << 28) - one) << 2);
}
IN num root(wide v) {
    if (v <= 0) return 0;
    int s = (__builtin_clzll((uint64_t)v) & ~1) - 2;
    uint32_t q = (uint32_t)((uint64_t)v << s >> 32);
    return (num)((high(q << 2, rsqrt(q) << 1) << 1) >> (s >> 1));
}
/* the direction of (a, b): 1 where it has none */
IN int unit(wide a, wide b, num *c, num *n) {
    uint64_t size = (uint64_t)(a ^ a >> 63) | (uint64_t)(b ^ b >> 63);
    int none = (a | b) == 0, s = __builtin_clzll(size | 1) - 1;
    int32_t x = (int32_t)((uint64_t)a << s >> 32), y = (int32_t)((uint64_t)b << s >> 32);
    uint32_t q = (uint32_t)(((int64_t)x * x + (int64_t)y * y) >> 32);
    int32_t g = (int32_t)rsqrt(none ? 1u << 30 : q);
    *c = none ? C(1) : (num)((int64_t)x * g >> 32) * 4;
    *n = (num)((int64_t)y * g >> 32) * 4;
    return none;
}
IN num radians(turn a) { return narrow((int64_t)(int32_t)a * C(PI_2)); }     /* up to an eighth of a turn either way */
IN turn quarters(turn a) { return (a + (1u << 29)) >> 30; }
IN turn quarter(turn k) { return k << 30; }
IN turn turns(num asine) { return (turn)narrow((int64_t)asine * C(1 / PI_2)); }
#else
typedef float num;
typedef float wide;
#define C(x) ((num)(x))
#define WIDE(x) ((num)(x))
#define FACTOR(x) ((num)(x))
typedef float turn;

void start(void) { }
IN num get(num x) { return x; }
IN num put(num x) { return x; }
IN turn get_turn(num x) { return x; }
IN num put_turn(turn a) { return a; }
IN num mul(num a, num b) { return a * b; }
IN num times(num a, num b) { return a * b; }
IN num dot(num a, num b, num c, num d) { return a * b + c * d; }
IN num beside(num c) { return (1 - c) * (1 + c); }
IN num narrow(num v) { return v; }
IN num root(num v) { return __builtin_sqrtf(v > 0 ? v : 0); }
IN int unit(num a, num b, num *c, num *n) {
    num q = a * a + b * b, g;
    int none = !(q > 0);
    g = 1 / __builtin_sqrtf(none ? 1 : q);
    *c = none ? 1 : a * g;
    *n = b * g;
    return none;
}
IN num radians(turn a) { return a; }
IN turn quarters(turn a) { return (num)(int)(a * C(1 / PI_2) + (a < 0 ? C(-0.5) : C(0.5))); }
IN turn quarter(turn k) { return k * C(PI_2); }
IN turn turns(num asine) { return asine; }
#endif

/* Angles: the reduced angle by polynomials; the arc sine of the smaller coordinate (to 4e-7), then the octant */
IN void sincos_of(turn a, num *c, num *n) {
    turn k = quarters(a);
    num r = radians(a - quarter(k)), x = mul(r, r);
    num s = mul(r, C(1) + mul(x, C(-0.166666546) + mul(x, C(0.00833216087) + mul(x, C(-0.000195152959)))));
    num t = C(1) + mul(x, C(-0.499999996) + mul(x, C(0.0416666233)
          + mul(x, C(-0.00138867637) + mul(x, C(0.0000243904487)))));
    int way = (int)k;
    num even = way & 1 ? s : t, odd = way & 1 ? t : s;
    *c = (way + 1) & 2 ? -even : even;
    *n = way & 2 ? -odd : odd;
}
IN turn angle_of(num c, num n) {
    num ac = c < 0 ? -c : c, an = n < 0 ? -n : n, s = ac < an ? ac : an, x = mul(s, s);
    num p = C(0.999994357) + mul(x, C(0.166959334) + mul(x, C(0.0707040092) + mul(x, C(0.0710479074)
          + mul(x, C(-0.0445396258) + mul(x, C(0.111135903))))));
    turn a = turns(mul(s, p));
    a = an > ac ? quarter(1) - a : a;
    a = c < 0 ? quarter(2) - a : a;
    return n < 0 ? -a : a;
}

/* Two joints in a plane: lengths, the sum of their squares, 1/(2 l1 l2) */
typedef struct { num l1, l2; wide square; num ratio; } plane;
static const plane links = {C(L1), C(L2), WIDE((L1) * (L1) + (L2) * (L2)), FACTOR(0.5 / (L1) / (L2))};
static const plane arm6 = {C(C2), C(K), WIDE((C2) * (C2) + (K) * (K)), FACTOR(0.5 / (C2) / (K))};

IN void tip(const num *j, num *x, num *y) {
    num a = C(L1) + mul(C(L2), j[2]), b = mul(C(L2), j[3]);
    *x = narrow(dot(a, j[0], -b, j[1]));
    *y = narrow(dot(a, j[1], b, j[0]));
}
/* j: cosine and sine of joint 1 and of joint 2 */
IN int solve(const plane *m, num x, num y, int down, num *j) {
    num c = times(narrow(dot(x, x, y, y) - m->square), m->ratio);
    int far = c > C(1) || c < C(-1);
    c = c > C(1) ? C(1) : c < C(-1) ? C(-1) : c;
    num s = root(beside(c));
    s = down ? -s : s;
    num k1 = m->l1 + mul(m->l2, c), k2 = mul(m->l2, s);
    int none = unit(dot(k1, x, k2, y), dot(k1, y, -k2, x), &j[0], &j[1]);
    j[2] = c; j[3] = s;
    return far | none << 1;
}

IN int fk2(const num *in, int way, num *out) {
    num j[4], x, y;
    (void)way;
    for (int i = 0; i < 4; i++) j[i] = get(in[i]);
    tip(j, &x, &y);
    out[0] = put(x); out[1] = put(y);
    return 0;
}
IN int fk2_angle(const num *in, int way, num *out) {
    num j[4], x, y;
    (void)way;
    sincos_of(get_turn(in[0]), &j[0], &j[1]);
    sincos_of(get_turn(in[1]), &j[2], &j[3]);
    tip(j, &x, &y);
    out[0] = put(x); out[1] = put(y);
    return 0;
}
IN int planar(const num *in, int way, num *j) { return solve(&links, get(in[0]), get(in[1]), way, j); }
IN int yawing(const num *in, int way, num *j) {
    num x = get(in[0]), y = get(in[1]);
    int none = unit(x, y, &j[4], &j[5]);
    return solve(&links, narrow(dot(x, j[4], y, j[5])), get(in[2]), way, j) | none << 1;
}

/* Six axes: r, the matrix by rows; branch: 1 the shoulder looks back, 2 sin(q3 + psi) < 0, 4 sin q5 < 0 */
IN void centre(const num *in, num *r, num *p, num *forward) {
    for (int i = 0; i < 9; i++) r[i] = get(in[i]);
    for (int i = 0; i < 3; i++) p[i] = get(in[9 + i]) - mul(C(C4), r[3 * i + 2]);
    p[2] -= C(C1);
    *forward = root(dot(p[0], p[0], p[1], p[1]) - WIDE((B) * (B)));
}
IN int shoulder(const num *p, num forward, num *j) {
    return unit(dot(forward, p[0], C(B), p[1]), dot(forward, p[1], C(-(B)), p[0]), &j[0], &j[1]) << 1
        | (dot(p[0], p[0], p[1], p[1]) < WIDE((B) * (B)));
}
/* q1 in j[0], j[1]; finds q2 to q6 */
IN int arm_and_wrist(const num *r, const num *p, num forward, int down, int flip, num *j) {
    num e[4];
    int flags = solve(&arm6, p[2], forward - C(A1), down, e);
    j[2] = e[0]; j[3] = e[1];
    j[4] = mul(C(CP), e[2]) + mul(C(NP), e[3]);
    j[5] = mul(C(CP), e[3]) - mul(C(NP), e[2]);
    num c1 = j[0], n1 = j[1];
    num c23 = mul(j[2], j[4]) - mul(j[3], j[5]), n23 = mul(j[3], j[4]) + mul(j[2], j[5]);
    num u = mul(c1, r[2]) + mul(n1, r[5]), m13 = mul(c23, u) - mul(n23, r[8]), m23 = mul(c1, r[5]) - mul(n1, r[2]);
    num c4, n4, least = C(8.0 / 65536);
    int straight = m13 < least && m13 > -least && m23 < least && m23 > -least;
    unit(dot(m13, C(1), 0, 0), dot(m23, C(1), 0, 0), &c4, &n4);
    c4 = straight ? C(1) : flip ? -c4 : c4;
    n4 = straight ? 0 : flip ? -n4 : n4;
    num t = -mul(n4, c23), w0 = mul(t, c1) - mul(c4, n1), w1 = mul(t, n1) + mul(c4, c1), w2 = mul(n4, n23);
    j[6] = c4; j[7] = n4;
    j[8] = mul(n23, u) + mul(c23, r[8]);
    j[9] = mul(c4, m13) + mul(n4, m23);
    j[10] = mul(w0, r[1]) + mul(w1, r[4]) + mul(w2, r[7]);
    j[11] = mul(w0, r[0]) + mul(w1, r[3]) + mul(w2, r[6]);
    return flags | straight << 1;
}
IN int branch6(const num *in, int way, num *j) {
    num r[9], p[3], forward;
    centre(in, r, p, &forward);
    forward = way & 1 ? -forward : forward;
    int flags = shoulder(p, forward, j);
    return flags | arm_and_wrist(r, p, forward, way & 2, way & 4, j);
}
IN int ik6_all(const num *in, int way, num *out) {
    num r[9], p[3], forward, j[12];
    int flags = 0;
    (void)way;
    centre(in, r, p, &forward);
#pragma unroll
    for (int back = 0; back < 2; back++) {
        flags |= shoulder(p, back ? -forward : forward, j);
#pragma unroll
        for (int down = 0; down < 2; down++) {
            num *o = out + 12 * (back + 2 * down), *flipped = o + 48;
            flags |= arm_and_wrist(r, p, back ? -forward : forward, down, 0, j);
#pragma unroll
            for (int i = 0; i < 12; i++) o[i] = flipped[i] = put(j[i]);
            flipped[6] = -o[6]; flipped[7] = -o[7]; flipped[9] = -o[9]; flipped[10] = -o[10]; flipped[11] = -o[11];
        }
    }
    return flags;
}
#define VECTORS(name, joints) IN int name(const num *in, int way, num *out) { \
    num j[2 * joints]; int flags = SOLVE(in, way, j); \
    for (int i = 0; i < 2 * joints; i++) out[i] = put(j[i]); \
    return flags; }
#define ANGLES(name, joints) IN int name(const num *in, int way, num *out) { \
    num j[2 * joints]; int flags = SOLVE(in, way, j); \
    _Pragma("unroll") for (int i = 0; i < joints; i++) out[i] = put_turn(angle_of(j[2 * i], j[2 * i + 1])); \
    return flags; }
#define SOLVE planar
VECTORS(ik2, 2)
ANGLES(ik2_angle, 2)
#undef SOLVE
#define SOLVE yawing
VECTORS(ik3, 3)
ANGLES(ik3_angle, 3)
#undef SOLVE
#define SOLVE branch6
VECTORS(ik6, 6)
ANGLES(ik6_angle, 6)

/* name, words of a pose, words of an answer */
#define EACH(X) X(fk2, 4, 2) X(ik2, 2, 4) X(ik3, 3, 6) X(ik6, 12, 12) X(ik6_all, 12, 96) \
    X(fk2_angle, 2, 2) X(ik2_angle, 2, 2) X(ik3_angle, 3, 3) X(ik6_angle, 12, 6)

typedef int kinematics(const num *in, int way, num *out);
static __attribute__((noinline)) int empty(const num *in, int way, num *out) {
    __asm__ volatile ("" : : "r"(in), "r"(way), "r"(out) : "memory");
    return 0;
}
#define CALL(name, ins, outs) \
    static __attribute__((noinline)) int call_##name(const num *in, int way, num *out) { return name(in, way, out); }
EACH(CALL)
#ifndef MORE                                            /* a core's driver, of ci/whynot.py */
#define MORE
#define SETUP
#endif
#define ENTRY(name, ins, outs) {call_##name, ins, outs},
static const struct { kinematics *call; int ins, outs; } table[] = {{empty, 1, 1}, EACH(ENTRY) MORE};

#ifdef __riscv
static inline uint32_t now(void) { uint32_t t; __asm__ volatile ("rdcycle %0" : "=r"(t) : : "memory"); return t; }
#else
#include <time.h>
#ifdef __x86_64__
#define FENCE __builtin_ia32_lfence()                   /* nothing of the call before or after */
#else
#define FENCE
#endif
static inline uint32_t now(void) {
    struct timespec t;
    FENCE;
    clock_gettime(CLOCK_MONOTONIC, &t);
    FENCE;
    return (uint32_t)((uint64_t)t.tv_sec * 1000000000 + (uint64_t)t.tv_nsec);
}
#endif

/* `count` poses one after the other, and what each took: ns, on the soft CPU clocks */
void each(int which, int count, const num *in, const int32_t *way, num *out, int32_t *flags, uint32_t *took) {
    kinematics *call = table[which].call;
    int ins = table[which].ins, outs = table[which].outs;
    for (int i = 0; i < count; i++, in += ins, out += outs) {
        int w = way[i];
        uint32_t from = now();
        flags[i] = call(in, w, out);
        took[i] = now() - from;
    }
}

#ifdef __riscv
/* Poses, ways, answers, flags and clocks lie where the test bench put and fetches them */
typedef struct {
    int32_t which, count;
    const num *in;
    const int32_t *way;
    num *out;
    int32_t *flags;
    uint32_t *took;
} job;
__attribute__((naked, section(".start"))) void _start(void) { __asm__ ("li sp, 0x20000\n call main\n ebreak"); }
int main(void) {
    start();
    SETUP
    for (const job *j = (const job *)0x20000; j->count; j++)
        each(j->which, j->count, j->in, j->way, j->out, j->flags, j->took);
    return 0;
}
#else
/* Many at a time: word j of pose i at in[j * STRIDE + i], so that the compiler takes a vector of poses */
enum { MANY = 512, STRIDE = MANY + 16 };
#define BATCH(name, ins, outs) \
    static void batch_##name(const num *restrict in, const int32_t *restrict way, num *restrict out) { \
    for (int i = 0; i < MANY; i++) { \
        num a[ins], o[outs]; \
        _Pragma("unroll") for (int j = 0; j < ins; j++) a[j] = in[j * STRIDE + i]; \
        name(a, way[i], o); \
        _Pragma("unroll") for (int j = 0; j < outs; j++) out[j * STRIDE + i] = o[j]; } }
EACH(BATCH)
#define BATCH_ENTRY(name, ins, outs) batch_##name,
static void (*const batches[])(const num *restrict, const int32_t *restrict, num *restrict) = {EACH(BATCH_ENTRY)};
/* ns of `times` batches */
double batch(int which, int times, const num *in, const int32_t *way, num *out) {
    uint32_t from = now();
    for (int i = 0; i < times; i++) {
        batches[which - 1](in, way, out);
        __asm__ volatile ("" : : "r"(out) : "memory");
    }
    return (double)(now() - from);
}
#endif
