package io.troupe.services.bus;

/** Input or output of a service. */
public record DataMessage(Address from, Purpose purpose, long sequence, Record payload) implements Message {}
