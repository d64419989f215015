package io.troupe.actor.guide;

import io.troupe.actor.*;
import io.troupe.actor.Promise;

/** The complete program of the README. */
public class Hello {
    interface Counter {
        Promise<Integer> add(int n);
    }

    static class Sum implements Counter {
        private int sum; // no lock: only the space's thread gets here

        @Override
        public Promise<Integer> add(int n) {
            return Promise.of(sum += n);
        }
    }

    public static void main(String[] args) {
        try (var space = ActorSpace.create(SpaceSettings.named("hello"))) {
            Counter counter = space.spawn(Counter.class, Sum::new);
            counter.add(2); // queued; returns at once
            counter.add(3).then(System.out::println); // the listener runs on the space's thread
        } // close() serves what was queued
    }
}
