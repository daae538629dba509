/* SPDX-License-Identifier: Apache-2.0 */
/* A thousand poses through each core by polling, and a thousand by interrupt. Sent for each: results, status, clocks.
 * main returns 0, or which core (0 inverse, 1 forward, 2 engine) failed: 16 and it is not there, 32 and it has refused
 * its program or a write, 48 and its interrupt has not come. */
#include "soc.h"
#include "table_ik2.h"
#include "table_fk2.h"
#include "camera.h"

#define POSES 1000
#define PATIENCE 100000     /* looks at what the handler says; a core needs a few */
#define INVERSE SOC_CORE(0)
#define FORWARD SOC_CORE(1)
#define ENGINE SOC_CORE(2)

static table_ik2_out joints;
static table_fk2_out tip;
static uint32_t status;                 /* of the engine */
static volatile uint32_t came;          /* interrupts */

void interrupt(uint32_t pending) {
    if (pending & SOC_IRQ(0)) {
        table_ik2_result(INVERSE, &joints);
        table_ik2_acknowledge(INVERSE);
    } else if (pending & SOC_IRQ(1)) {
        table_fk2_result(FORWARD, &tip);
        table_fk2_acknowledge(FORWARD);
    } else if (pending & SOC_IRQ(2)) {
        kinematics_engine_out out;
        kinematics_engine_result(ENGINE, &out);
        status = out.status;
        kinematics_engine_acknowledge(ENGINE);
    }
    came = pending;
}

/* waits for the handler: 0, or -1 where the interrupt does not come */
static int wait(void) {
    uint32_t i;
    for (i = 0; i < PATIENCE && !came; i++) { }
    if (!came) return -1;
    came = 0;
    __asm__ volatile ("" ::: "memory");     /* results are read after this */
    return 0;
}

/* the same numbers as `draws` of ci/soc.py, signed, of so many bits */
static int32_t draw(int bits) {
    static uint32_t state = 1;
    state = state * 1664525u + 1013904223u;
    return (int32_t)state >> (32 - bits);
}

static int inverse(int by_interrupt) {
    for (int i = 0; i < POSES; i++) {
        const int32_t x = draw(15), y = draw(15);       /* 64 units each way: the arm reaches 60 */
        const uint32_t elbow = (uint32_t)draw(1) & 1;
        const uint32_t began = soc_clocks();
        if (by_interrupt) {
            table_ik2_start(INVERSE, x, y, elbow);
            if (wait()) return 48;
        } else {
            table_ik2_run(INVERSE, x, y, elbow, &joints);
        }
        const uint32_t clocks = soc_clocks() - began;
        soc_send(joints.j1);
        soc_send(joints.j2);
        soc_send(joints.status);
        soc_send(clocks);
    }
    return 0;
}

static int forward(int by_interrupt) {
    for (int i = 0; i < POSES; i++) {
        const uint32_t j1 = (uint32_t)draw(18), j2 = (uint32_t)draw(18);
        const uint32_t began = soc_clocks();
        if (by_interrupt) {
            table_fk2_start(FORWARD, j1, j2);
            if (wait()) return 49;
        } else {
            table_fk2_run(FORWARD, j1, j2, &tip);
        }
        const uint32_t clocks = soc_clocks() - began;
        soc_send((uint32_t)tip.x);
        soc_send((uint32_t)tip.y);
        soc_send(tip.status);
        soc_send(clocks);
    }
    return 0;
}

/* two cameras in turn, a context each; now and then a point on the pan axis, where the last pan is held */
static int engine(int by_interrupt) {
    for (int i = 0; i < POSES; i++) {
        const uint32_t camera_of = (uint32_t)i & 1;
        const int32_t x = i % 50 < 2 ? 0 : draw(25), y = i % 50 < 2 ? 0 : draw(25), z = draw(25);
        const uint32_t began = soc_clocks();
        kinematics_engine_put(ENGINE, camera_of, CAMERA_IN_X, x);
        kinematics_engine_put(ENGINE, camera_of, CAMERA_IN_Y, y);
        kinematics_engine_put(ENGINE, camera_of, CAMERA_IN_Z, z);
        const uint32_t begins = soc_clocks();
        if (by_interrupt) {
            kinematics_engine_begin(ENGINE, camera_of, &camera, 0);
            kinematics_engine_interrupt(ENGINE, 1);     /* after the start, which clears what polling has left */
            if (wait()) return 50;
            kinematics_engine_interrupt(ENGINE, 0);
        } else if (kinematics_engine_play(ENGINE, camera_of, &camera, 0, &status)) {
            return 34;
        }
        const uint32_t run = soc_clocks() - begins;
        const int32_t c1 = kinematics_engine_get(ENGINE, camera_of, CAMERA_OUT_C1);
        const int32_t n1 = kinematics_engine_get(ENGINE, camera_of, CAMERA_OUT_N1);
        const int32_t c2 = kinematics_engine_get(ENGINE, camera_of, CAMERA_OUT_C2);
        const int32_t n2 = kinematics_engine_get(ENGINE, camera_of, CAMERA_OUT_N2);
        const uint32_t clocks = soc_clocks() - began;
        soc_send((uint32_t)c1);
        soc_send((uint32_t)n1);
        soc_send((uint32_t)c2);
        soc_send((uint32_t)n2);
        soc_send(status);
        soc_send(clocks);
        soc_send(run);
    }
    return 0;
}

int main(void) {
    int wrong;
    if (!table_ik2_probe(INVERSE)) return 16;
    if (!table_fk2_probe(FORWARD)) return 17;
    if (!kinematics_engine_probe(ENGINE)) return 18;
    table_ik2_configure(INVERSE, &table_ik2_arm);
    table_fk2_configure(FORWARD, &table_fk2_arm);
    if (kinematics_engine_load(ENGINE, &camera)) return 34;
    for (uint32_t context = 0; context < 2; context++) {
        kinematics_engine_prepare(ENGINE, context, &camera);
        kinematics_engine_put(ENGINE, context, CAMERA_CFG_D, context ? 327680 : 819200);
        kinematics_engine_put(ENGINE, context, CAMERA_CFG_H, context ? 12288000 : 8192000);
    }
    if ((wrong = inverse(0)) || (wrong = forward(0)) || (wrong = engine(0))) return wrong;
    soc_take(SOC_IRQ(0) | SOC_IRQ(1) | SOC_IRQ(2));
    table_ik2_acknowledge(INVERSE);     /* of the last result by polling */
    table_ik2_interrupt(INVERSE, 1);
    table_fk2_acknowledge(FORWARD);
    table_fk2_interrupt(FORWARD, 1);
    if ((wrong = inverse(1)) || (wrong = forward(1)) || (wrong = engine(1))) return wrong;
    if (table_ik2_flags(INVERSE)) return 32;
    if (table_fk2_flags(FORWARD)) return 33;
    if (kinematics_engine_flags(ENGINE)) return 34;
    return 0;
}
