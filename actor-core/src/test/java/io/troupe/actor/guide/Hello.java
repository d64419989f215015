package io.troupe.actor.guide;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.SpaceSettings;
import io.troupe.actor.promise.Promise;
import java.util.ArrayList;
import java.util.List;

/** The complete program of the README. */
public class Hello {
    interface Greeter {
        Promise<String> greet(String name); // a request

        void remember(String name); // a one-way message
    }

    static class PoliteGreeter implements Greeter {
        private final List<String> names = new ArrayList<>(); // no lock: only the space's thread gets here

        @Override
        public Promise<String> greet(String name) {
            return Promise.of(names.contains(name) ? "Hello again, " + name : "Hello, " + name);
        }

        @Override
        public void remember(String name) {
            names.add(name);
        }
    }

    public static void main(String[] args) {
        try (var space = ActorSpace.create(SpaceSettings.named("hello"))) {
            Greeter greeter = space.spawn(Greeter.class, PoliteGreeter::new);
            greeter.remember("Ada"); // queued; returns at once
            greeter.greet("Ada").then(text -> System.out.println(text)); // runs on the space's thread
        } // close() serves what was queued
    }
}
