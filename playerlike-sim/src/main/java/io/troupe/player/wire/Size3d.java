package io.troupe.player.wire;

/**
 * How large something is, in metres: {@code width} is its y extent, {@code length} its x extent, as in Player's bbox3d.
 */
public record Size3d(double widthM, double lengthM, double heightM) {}
