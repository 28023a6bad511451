"""An independent numerical reference: bodies, joints, velocities and searches, in numpy alone.

Source: J. Garcia de Jalon, E. Bayo, Kinematic and Dynamic Simulation of Multibody Systems (1994), ch. 3, and
the definitions of Zlatanov, Fenton, Benhabib (1998), section 2.2.  Of singsym it reads the mechanism's data.
"""
