package io.troupe.actor.internal;

/**
 * A callback of this library whose {@code isCancelled()} only reads a flag, so that any thread may call it; that of
 * other callbacks runs on the space of the reader.
 */
public interface CancellationFlag {
    boolean isCancelled();
}
