"""Conditions as incidences of a mechanism's points, lines, axes and planes, in the Grassmann-Cayley algebra.

`legs` and `wrenches` find the lines that L_I consists of, `platforms` the brackets of these, `poles` those of
any three links in the plane; `slides` and `hinges` what lines are perpendicular to or meet; `arms` what is
said of serial arms, `joint_values` the values of a joint.
"""
