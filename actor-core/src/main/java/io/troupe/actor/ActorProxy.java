package io.troupe.actor;

/**
 * Implemented by every generated proxy. For generated code.
 *
 * @hidden
 */
public interface ActorProxy {
    /** The actor behind the proxy; the name cannot clash with a method of a user. */
    ActorCell troupe$cell();
}
