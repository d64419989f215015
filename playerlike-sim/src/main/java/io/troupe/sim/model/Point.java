package io.troupe.sim.model;

/** A point of the plane, in metres. */
public record Point(double x, double y) {}
