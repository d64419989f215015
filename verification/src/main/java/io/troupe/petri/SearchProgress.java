package io.troupe.petri;

/**
 * How far a search over markings is.
 *
 * @param markings how many were found
 * @param expanded how many of them had their successors looked for
 * @param edges how many firings between them were found
 * @param dead how many of the expanded ones are dead
 */
public record SearchProgress(int markings, int expanded, int edges, int dead) {}
