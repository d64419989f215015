package io.troupe.petri;

/**
 * The progress of a search over markings.
 *
 * @param markings the number of markings found
 * @param expanded the number of markings whose successors were computed
 * @param edges the number of firings found between them
 * @param dead the number of expanded markings that are dead
 */
public record SearchProgress(int markings, int expanded, int edges, int dead) {}
