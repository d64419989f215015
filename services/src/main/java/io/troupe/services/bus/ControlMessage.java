package io.troupe.services.bus;

/** Manages a service: invokes it, terminates it, checks its health. */
public record ControlMessage(Address from, Purpose purpose, long sequence, Record payload) implements Message {}
