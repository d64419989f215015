package io.troupe.petri.wiring;

/** One way out of a state. */
sealed interface Step {
    String from();

    String to();

    /** A private step, in which no other component takes part. */
    record Does(String from, String label, String to) implements Step {}

    /** A call to the component in {@code role}; the caller waits for the answer. */
    record Requests(String from, String role, String call, String to) implements Step {}

    /** Waits for a call and answers it. */
    record Provides(String from, String call, String to) implements Step {}

    /** Goes back to the first state. */
    record Stops(String from, String to) implements Step {}
}
