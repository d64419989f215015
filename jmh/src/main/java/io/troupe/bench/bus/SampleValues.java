package io.troupe.bench.bus;

import io.troupe.bus.BusTopic;
import io.troupe.bus.Operation;
import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.Optional;
import java.util.Random;

/** The values that are encoded and sent. The same seed gives the same values. */
final class SampleValues {
    static final BusTopic<Sonar> SONAR = new BusTopic<>("robot1/sonar", Sonar.class);
    static final Operation<Text, Text> ECHO = new Operation<>("echo", Text.class, Text.class, Operation.Kind.DATA);

    private static final int RANGES = 16;
    private static final double MILLIS = 1_000;
    private static final Instant START = Instant.ofEpochSecond(1_795_000_000);

    private final Random random;

    SampleValues(long seed) {
        random = new Random(seed);
    }

    /** A reading of sixteen sonars. */
    record Sonar(List<Double> rangesM, long number, Instant time) {}

    record Velocity(double forwardMps, double turnRadps) {}

    /** The payload of a request and of its reply. */
    record Text(String text) {}

    /** A value with parts of all kinds. */
    record Report(
            String robot,
            Velocity velocity,
            Optional<String> note,
            Activity activity,
            List<Sighting> sightings,
            Duration running,
            Instant time) {}

    /** What a robot does. */
    sealed interface Activity {
        record Driving(double speedMps, Optional<Double> goalM) implements Activity {}

        record Resting(String reason) implements Activity {}
    }

    record Sighting(String colour, double bearingRad, int pixels) {}

    /** Ranges in whole millimetres, as a device gives them. */
    Sonar sonar() {
        List<Double> ranges = random.ints(RANGES, 200, 5_000)
                .mapToObj(millimetres -> millimetres / MILLIS)
                .toList();
        return new Sonar(ranges, random.nextInt(1_000_000), time());
    }

    Velocity velocity() {
        return new Velocity(random.nextInt(500) / MILLIS, random.nextInt(1_000) / MILLIS);
    }

    Report report() {
        boolean driving = random.nextBoolean();
        return new Report(
                "robot" + random.nextInt(10),
                velocity(),
                driving ? Optional.empty() : Optional.of("battery low"),
                driving
                        ? new Activity.Driving(random.nextInt(500) / MILLIS, Optional.of(random.nextInt(900) / MILLIS))
                        : new Activity.Resting("waits for its turn"),
                List.of(sighting("red"), sighting("green")),
                Duration.ofMillis(random.nextInt(1_000_000)),
                time());
    }

    private Sighting sighting(String colour) {
        return new Sighting(colour, random.nextInt(1_000) / MILLIS, random.nextInt(2_000));
    }

    private Instant time() {
        return START.plusMillis(random.nextInt(1_000_000_000)).plusNanos(random.nextInt(1_000_000));
    }

    /** A text of that many ASCII letters. */
    Text text(int bytes) {
        var text = new StringBuilder(bytes);
        random.ints(bytes, 'a', 'z' + 1).forEach(letter -> text.append((char) letter));
        return new Text(text.toString());
    }
}
