package io.troupe.actor;

/**
 * What every generated proxy is as well. For generated code.
 *
 * @hidden
 */
public interface ActorProxy {
    /** The actor behind the proxy; the name cannot meet a user's method. */
    ActorCell troupe$cell();
}
