"""Parallel robots whose legs are a crank, a rod and two ball joints (RUS): the paper's robot and its kin.

The reconfigurable robot of Sanchez-Alonso et al., RIAI 13 (2016) 247-257, any six-legged rotary Stewart platform, and
the three-legged rotary delta, in float64. Lengths in millimetres, angles in radians, everything vectorised over poses.

    geometry          robot files, crank axes, ball joints of the platform
    position          inverse (closed form, both branches of a leg), forward (Newton), assemblies
    motion            screws: Jacobians, velocity, acceleration
    singularity       the three types, conditioning
    reconfiguration   manipulability and the best angle of the reconfiguration links
    delta             forward kinematics of the delta: three spheres, closed form

Where a printed equation is wrong, the function that computes it says so under "Paper".
"""
