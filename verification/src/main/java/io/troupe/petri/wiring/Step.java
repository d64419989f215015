package io.troupe.petri.wiring;

/** One way out of a state. */
sealed interface Step {
    String from();

    String to();

    /** A step that concerns nobody else. */
    record Does(String from, String label, String to) implements Step {}

    /** A call to the component that plays {@code role}, until it is answered. */
    record Requests(String from, String role, String call, String to) implements Step {}

    /** Waits for a call and answers it. */
    record Provides(String from, String call, String to) implements Step {}

    /** Back to the first state. */
    record Stops(String from, String to) implements Step {}
}
