package io.troupe.petri.drawing;

/** A point of a drawing in pixels, y downwards. */
record Point(double x, double y) {}
