package io.troupe.player.structures.log;

/** A part of the messages of a recorder; no device here uses it. */
public class PlayerLogSetReadRewind {}
