package io.troupe.actor.internal;

/** Implemented by every generated proxy. For generated code. */
public interface ActorProxy {
    /** The actor behind the proxy; the name cannot clash with a method of a user. */
    Recipient troupe$cell();
}
