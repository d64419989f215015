package io.troupe.petri.drawing;

/** Width and height in pixels. */
record Size(double width, double height) {}
