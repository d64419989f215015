package io.troupe.petri.drawing;

/** A point of a drawing in pixels, y downwards. */
record PixelPoint(double x, double y) {}
