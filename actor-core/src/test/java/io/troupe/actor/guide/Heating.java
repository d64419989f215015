package io.troupe.actor.guide;

import io.troupe.actor.ActorSpace;
import io.troupe.actor.Promise;
import io.troupe.actor.SpaceSettings;

/** The first program of docs/guide/01-actors.md, complete. */
public class Heating {
    interface Thermostat {
        void set(double degrees); // void: a one-way message

        Promise<Double> read(); // Promise: a request
    }

    static final class Heater implements Thermostat {
        private double degrees = 20;

        @Override
        public void set(double degrees) {
            this.degrees = degrees;
        }

        @Override
        public Promise<Double> read() {
            return Promise.of(degrees);
        }
    }

    public static void main(String[] args) {
        try (var space = ActorSpace.create(SpaceSettings.named("heating"))) {
            Thermostat heater = space.spawn(Thermostat.class, Heater::new);
            heater.set(21.5);
            heater.read().then(degrees -> System.out.println(degrees));
        } // close() serves what was queued
    }
}
