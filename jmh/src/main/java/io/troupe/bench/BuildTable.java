package io.troupe.bench;

import java.util.List;

/**
 * A table of benchmarks that an older build can run too.
 *
 * <p><b>Role.</b> {@code CompareBuilds} asks for its rows, and runs them in the JVMs of both builds. A table has no
 * state before the first turn, so that the names of the rows cost nothing.
 *
 * <p><b>Errors.</b> A {@link LinkageError} means that the build lacks what a row needs; the other rows still run.
 */
public interface BuildTable {
    /** The rows, in the order in which they run in one JVM. */
    List<Row> rows();

    /** Runs about {@code operations} operations of a row; builds that are asked for the same number do the same. */
    Turn turn(String row, int operations) throws Exception;

    /** The bytes that one {@link Row#kept} keeps on the heap, after the turns of all rows. */
    double keptBytes(String row) throws Exception;

    /** When a row runs. */
    enum Choice {
        /** Also in a quick run. */
        QUICK,
        /** Unless the run is quick. */
        USUAL,
        /** Only if its name is given. */
        NAMED
    }

    /**
     * A row.
     *
     * @param kept whose retained bytes the table has, for example an actor; empty if it has none
     */
    record Row(String name, Choice choice, String kept) {}

    /**
     * The result of one turn.
     *
     * @param nanos the time of all operations by the wall clock
     * @param processorNanos the processor time of all threads of Java meanwhile
     * @param bytes what all threads of the JVM allocated meanwhile
     * @param operations how many were run
     * @param answer what equal builds compute equally; empty if there is nothing to compare
     */
    record Turn(double nanos, double processorNanos, double bytes, long operations, String answer) {
        /** This turn as a line of the pipe. */
        public String line() {
            return nanos + " " + processorNanos + " " + bytes + " " + operations + " " + answer;
        }

        /** Reads a line of the pipe. */
        public static Turn parse(String line) {
            String[] words = line.split(" ", 5);
            if (words.length != 5) {
                throw new IllegalArgumentException(
                        "a turn is \"" + line + "\", expected two times, bytes, operations and an answer");
            }
            return new Turn(
                    Double.parseDouble(words[0]),
                    Double.parseDouble(words[1]),
                    Double.parseDouble(words[2]),
                    Long.parseLong(words[3]),
                    words[4]);
        }

        public Turn withAnswer(String text) {
            return new Turn(nanos, processorNanos, bytes, operations, text);
        }

        public double nanosEach() {
            return nanos / operations;
        }

        public double processorNanosEach() {
            return processorNanos / operations;
        }

        public double bytesEach() {
            return bytes / operations;
        }
    }
}
