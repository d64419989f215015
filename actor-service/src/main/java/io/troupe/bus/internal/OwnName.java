package io.troupe.bus.internal;

/**
 * The name of a port of a part of Troupe, or of an actor that is a service. It may have the characters that other ports
 * may not have: {@code $}, with which names of Troupe begin, and {@code #}, before a number.
 */
public record OwnName(String name) {}
