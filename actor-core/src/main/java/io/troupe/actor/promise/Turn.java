package io.troupe.actor.promise;

/**
 * On whose behalf a home's thread is running now. An object of its own that is replaced now and then, because it is
 * written at every turn, and storing a reference into an object that has grown old costs a fence under G1 (until JEP
 * 522, JDK 26).
 */
final class Turn {
    Owner owner;

    Turn(Owner owner) {
        this.owner = owner;
    }
}
