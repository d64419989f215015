package io.troupe.actor.promise;

/**
 * Holds the owner on whose behalf a home's thread is running. This is a separate object that is replaced periodically,
 * because the field is written at every turn, and storing a reference into an object of the old generation costs a
 * fence under G1 (until JEP 522, JDK 26).
 */
final class CurrentOwner {
    Owner owner;

    CurrentOwner(Owner owner) {
        this.owner = owner;
    }
}
