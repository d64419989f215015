package io.troupe.view.live;

import io.troupe.sim.model.ColouredBox;
import io.troupe.sim.model.Pose;
import java.util.List;
import java.util.Locale;

/**
 * What a viewer can ask for. Each command has a form as a line of words, in which robots count from 1: {@code pause},
 * {@code resume}, {@code step}, {@code speed 2}, {@code reset}, {@code place 1 0.5 -1.2 0.3}, {@code drive 1 0.3 -0.5},
 * {@code release 1}, {@code box 1 ff0000 0.5 -1.2}, {@code unbox 1}.
 */
public sealed interface ViewCommand {
    /** Time stands still. */
    record Pause() implements ViewCommand {}

    /** Time passes again. */
    record Resume() implements ViewCommand {}

    /** One interval of paused time passes. */
    record Step() implements ViewCommand {}

    /** @param factor simulated seconds per second; 0 = as fast as possible */
    record Speed(double factor) implements ViewCommand {}

    /** A command that changes what happens in the world; the log of a run records it. */
    sealed interface Intervention extends ViewCommand {
        /** As a line of words. */
        String words();

        /** Whether it replaces an earlier one that has not taken effect. */
        default boolean replaces(Intervention earlier) {
            return false;
        }
    }

    /** The world returns to its start. */
    record Reset() implements Intervention {
        @Override
        public String words() {
            return "reset";
        }

        @Override
        public boolean replaces(Intervention earlier) {
            return true;
        }
    }

    /** Puts a robot, by index, at a pose. */
    record Place(int robot, Pose pose) implements Intervention {
        @Override
        public String words() {
            return "place " + (robot + 1) + " " + pose.x() + " " + pose.y() + " " + pose.headingRad();
        }

        @Override
        public boolean replaces(Intervention earlier) {
            return earlier instanceof Place other && other.robot == robot;
        }
    }

    /** Drives a robot, by index, instead of its service, until it is released. */
    record Drive(int robot, double forwardMps, double turnRadps) implements Intervention {
        @Override
        public String words() {
            return "drive " + (robot + 1) + " " + forwardMps + " " + turnRadps;
        }

        @Override
        public boolean replaces(Intervention earlier) {
            return earlier instanceof Drive other && other.robot == robot;
        }
    }

    /** Returns a robot, by index, to its service. */
    record Release(int robot) implements Intervention {
        @Override
        public String words() {
            return "release " + (robot + 1);
        }

        @Override
        public boolean replaces(Intervention earlier) {
            return earlier instanceof Drive other && other.robot == robot;
        }
    }

    /** Puts a box into the world, or moves it. */
    record PutBox(ColouredBox box) implements Intervention {
        @Override
        public String words() {
            return "box " + box.words();
        }

        @Override
        public boolean replaces(Intervention earlier) {
            return earlier instanceof PutBox other && other.box.number() == box.number();
        }
    }

    /** Removes a box, by number. */
    record RemoveBox(int number) implements Intervention {
        @Override
        public String words() {
            return "unbox " + number;
        }

        @Override
        public boolean replaces(Intervention earlier) {
            return earlier instanceof PutBox other && other.box.number() == number;
        }
    }

    /** Largest absolute value of a number in a command. */
    double MOST = 1e6;

    /**
     * Parses a line of words.
     *
     * @param robots number of robots of the world
     * @throws IllegalArgumentException with the word that is wrong
     */
    static ViewCommand parse(String line, int robots) {
        List<String> words = List.of(line.strip().split(" +", -1));
        String what = words.getFirst();
        int expected = switch (what) {
            case "pause", "resume", "step", "reset" -> 1;
            case "speed", "release", "unbox" -> 2;
            case "drive" -> 4;
            case "place", "box" -> 5;
            default ->
                throw new IllegalArgumentException("'" + shortened(what) + "' is no command, expected one of "
                        + String.join(", ", RunControl.ALL));
        };
        if (words.size() != expected) {
            throw new IllegalArgumentException(
                    "'" + what + "' has " + (words.size() - 1) + " words after it, expected " + (expected - 1));
        }
        return switch (what) {
            case "pause" -> new Pause();
            case "resume" -> new Resume();
            case "step" -> new Step();
            case "reset" -> new Reset();
            case "speed" -> speed(words.get(1));
            case "release" -> new Release(robot(words.get(1), robots));
            case "drive" -> new Drive(robot(words.get(1), robots), number(words.get(2)), number(words.get(3)));
            case "box" -> new PutBox(ColouredBox.parse(words.subList(1, 5)));
            case "unbox" -> new RemoveBox(ColouredBox.number(words.get(1)));
            default ->
                new Place(
                        robot(words.get(1), robots),
                        new Pose(number(words.get(2)), number(words.get(3)), number(words.get(4))));
        };
    }

    private static Speed speed(String word) {
        double factor = number(word);
        if (factor < 0) {
            throw new IllegalArgumentException("the speed is " + word + ", expected 0 or more");
        }
        return new Speed(factor);
    }

    /**
     * The index of a robot by its number, which begins with 1.
     *
     * @throws IllegalArgumentException if the word is no number from 1 to {@code robots}
     */
    static int robot(String word, int robots) {
        if (word.matches("[0-9]{1,6}")) {
            int number = Integer.parseInt(word);
            if (number >= 1 && number <= robots) {
                return number - 1;
            }
        }
        throw new IllegalArgumentException("robot '" + shortened(word) + "', expected a number from 1 to " + robots);
    }

    private static double number(String word) {
        if (word.matches("[-+]?[0-9]{1,20}(\\.[0-9]{0,20})?([eE][-+]?[0-9]{1,3})?")) {
            double value = Double.parseDouble(word);
            if (StrictMath.abs(value) <= MOST) {
                return value;
            }
        }
        throw new IllegalArgumentException(
                "'" + shortened(word) + "', expected a number of at most " + String.format(Locale.ROOT, "%.0f", MOST));
    }

    private static String shortened(String word) {
        return word.length() > 20 ? word.substring(0, 20) + ".." : word;
    }
}
