package io.troupe.sim;

/** The start of a contact between two bodies. It is reported once, however long the bodies keep touching. */
public record Contact(long timeMicros, int robot, String other, int otherRobot) {}
