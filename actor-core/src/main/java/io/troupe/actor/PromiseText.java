package io.troupe.actor;

import io.troupe.actor.internal.loop.PlainText;

/**
 * Describes a promise in messages. Iterative, because a chain of promises may have any length; bounded, because a
 * message must not.
 */
final class PromiseText {
    private static final int SPELLED_OUT = 8;
    private static final int COUNTED = 100;

    private PromiseText() {}

    /**
     * Describes the promise for which this chain of stages and time limits waits, with the words for the last few
     * links. A chain that is too long is abbreviated.
     */
    static String describe(Promise<?> last) {
        var before = new StringBuilder();
        var behind = new StringBuilder();
        int more = 0;
        Promise<?> first = last;
        for (Promise<?> source = first.source(); source != null; source = first.source()) {
            if (before.length() + behind.length() > 0 && ++more >= SPELLED_OUT) {
                return before + "promise after " + origin(source, more) + behind;
            }
            if (first instanceof TimeLimitedPromise<?> limited) {
                behind.insert(0, " within " + limited.timeout());
            } else {
                before.append("promise after ");
            }
            first = source;
        }
        return before + nameOf(first) + behind;
    }

    private static String origin(Promise<?> from, int linksBefore) {
        int links = 1;
        Promise<?> first = from;
        for (Promise<?> source = first.source(); source != null; source = first.source()) {
            if (linksBefore + ++links > COUNTED) {
                return "more than " + (links - 1) + " others";
            }
            first = source;
        }
        return links + " others after " + nameOf(first);
    }

    /** The progress of the promise for which this chain waits; see {@link Promise#progress}. */
    static String progress(Promise<?> last) {
        Promise<?> first = last;
        int links = 0;
        for (Promise<?> source = first.source(); source != null; source = first.source()) {
            if (++links > COUNTED) {
                return "";
            }
            first = source;
        }
        return first.progress();
    }

    private static String nameOf(Promise<?> first) {
        boolean isNameless = first instanceof Stage || first instanceof Deferred || first instanceof Promise.Settled;
        return isNameless ? "promise" : first.name();
    }

    /** The result of {@code toString}: the name while pending, afterwards the name with the value or the error. */
    static String withOutcome(String name, Promise<?> promise) {
        Object outcome = promise.outcomeNow();
        if (outcome == null) {
            return name;
        }
        return promise.error() instanceof Throwable error
                ? name + ", rejected with " + PlainText.of(error)
                : name + ", fulfilled with " + PlainText.of(promise.getNow());
    }
}
