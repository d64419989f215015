package io.troupe.sim.scenario;

/** A point of the plane, in metres. */
public record Point(double x, double y) {}
