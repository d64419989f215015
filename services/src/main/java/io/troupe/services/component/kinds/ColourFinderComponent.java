package io.troupe.services.component.kinds;

import io.troupe.actor.Promise;
import io.troupe.services.behaviour.ColourFinder;
import io.troupe.services.component.ApplicationData;
import io.troupe.services.component.Buffering;
import io.troupe.services.component.Component;
import io.troupe.services.component.ComponentCommunication;
import io.troupe.services.component.Conversion;
import io.troupe.services.component.kinds.RobotTopics.BlobsReading;
import io.troupe.services.component.kinds.RobotTopics.ColourSeen;
import java.util.List;
import java.util.OptionalInt;
import java.util.Set;
import org.jspecify.annotations.Nullable;

/**
 * Makes a component of the colour finder. A component named {@code c} subscribes to {@code c/blobs}, and publishes on
 * {@code c/colours} when the largest colour in sight changes to another colour.
 *
 * <p><b>Source.</b> Paper, section 3.2.
 */
public final class ColourFinderComponent {
    private ColourFinderComponent() {}

    /**
     * Makes a component.
     *
     * @param name name of the component on the bus, and prefix of its topics
     * @param ignored colours without a meaning, as {@code 0x00RRGGBB}, such as those of walls and other robots
     */
    public static Component<?, ?> of(String name, Set<Integer> ignored) {
        Set<Integer> unseen = Set.copyOf(ignored);
        return new Component<>(
                "colourFinder",
                List.of("findsColours"),
                List.of(RobotTopics.blobs(name)),
                List.of(RobotTopics.colours(name)),
                () -> new Finder(unseen),
                new ColoursConversion(name),
                Buffering.STREAM,
                Buffering.STREAM);
    }

    private static final class Finder implements ComponentCommunication<BlobsReading, ColourSeen> {
        private final Set<Integer> ignored;
        private @Nullable Signals<? super ColourSeen> signals;
        private OptionalInt inSight = OptionalInt.empty();

        Finder(Set<Integer> ignored) {
            this.ignored = ignored;
        }

        @Override
        public Promise<@Nullable Void> invoke(Signals<? super ColourSeen> newSignals) {
            signals = newSignals;
            return Promise.done();
        }

        @Override
        public void data(BlobsReading picture) {
            var found = ColourFinder.find(picture.blobs(), colour -> !ignored.contains(colour));
            if (found.isPresent() && !found.equals(inSight) && signals != null) {
                signals.data(new ColourSeen(picture.timeSeconds(), found.getAsInt()));
            }
            inSight = found;
        }

        @Override
        public Promise<@Nullable Void> terminate() {
            return Promise.done();
        }

        @Override
        public Promise<@Nullable Void> health() {
            return Promise.done();
        }
    }

    private record ColoursConversion(String name) implements Conversion<BlobsReading, ColourSeen> {
        @Override
        public List<ApplicationData<?>> toApplication(ColourSeen output) {
            return List.of(new ApplicationData<>(RobotTopics.colours(name), output));
        }

        @Override
        public BlobsReading toComponent(ApplicationData<?> input) {
            if (input.value() instanceof BlobsReading picture) {
                return picture;
            }
            throw new IllegalArgumentException(input + " is no picture");
        }
    }
}
