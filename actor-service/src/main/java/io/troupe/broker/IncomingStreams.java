package io.troupe.broker;

import io.troupe.actor.Callback;
import io.troupe.actor.Promise;
import io.troupe.bus.Address;
import io.troupe.bus.RemoteFailure;
import io.troupe.bus.internal.UnreadableException;
import java.lang.reflect.Type;
import java.security.SecureRandom;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.Predicate;
import org.jspecify.annotations.Nullable;

/** The streams that a connection reads, for the callbacks that it has sent to other processes. On its space. */
final class IncomingStreams {
    private static final CallMessages.Received MORE = new CallMessages.Received(true);
    private static final CallMessages.Received NO_MORE = new CallMessages.Received(false);

    private final CallableMethods.Values values;
    private final Map<Long, Stream> open = new HashMap<>();
    /** Not from 0: items for an earlier process of this name are for none of these. */
    private long last = new SecureRandom().nextLong(1L << 52);

    IncomingStreams(CallableMethods.Values values) {
        this.values = values;
    }

    private record Source(Address actor, String method) {}

    /** One stream. */
    private final class Stream {
        final RemoteActor from;
        private final Source source;
        private final Callback<@Nullable Object> callback;
        private final Type type;
        private long expected = 1;

        Stream(RemoteActor from, Source source, Callback<@Nullable Object> callback, Type type) {
            this.from = from;
            this.source = source;
            this.callback = callback;
            this.type = type;
        }

        /** Returns whether the stream goes on. */
        boolean receive(CallMessages.StreamPart part) {
            long missing = part.number() - expected;
            if (missing != 0) {
                callback.fail(new IllegalStateException(missing + " items of the stream of " + source.method + " from "
                        + source.actor + " were lost, before number " + part.number()));
                return false;
            }
            expected++;
            return switch (part.part()) {
                case CallMessages.Item item -> next(item);
                case CallMessages.End end -> {
                    callback.finish();
                    yield false;
                }
                case CallMessages.Failed(String errorType, String message) -> {
                    callback.fail(new RemoteFailure(source.actor, source.method, errorType, message));
                    yield false;
                }
            };
        }

        private boolean next(CallMessages.Item item) {
            if (callback.isCancelled()) {
                return false;
            }
            Object value;
            try {
                value = values.decode(type, item.value());
            } catch (UnreadableException unreadable) {
                callback.fail(new IllegalStateException(
                        "an item of the stream of " + source.method + " from " + source.actor + " cannot be read: "
                                + unreadable.getMessage(),
                        unreadable));
                return false;
            }
            callback.next(value);
            return true; // a reader that cancels now is noticed with the next item
        }
    }

    /** Returns the number of a new stream. */
    long open(RemoteActor from, String method, Callback<@Nullable Object> callback, Type type) {
        open.put(++last, new Stream(from, new Source(from.address(), method), callback, type));
        return last;
    }

    Promise<CallMessages.Received> receive(CallMessages.StreamPart part) {
        Stream stream = open.get(part.stream());
        if (stream == null) {
            return Promise.of(NO_MORE); // it has ended here
        }
        if (stream.receive(part)) {
            return Promise.of(MORE);
        }
        open.remove(part.stream());
        return Promise.of(NO_MORE);
    }

    /** Ends streams with an error: they will get no more items. */
    void fail(List<Long> numbers, Throwable why) {
        numbers.forEach(number -> fail(open.remove(number), why));
    }

    /** Ends those streams of a call that have got nothing: the call may have been lost. */
    void failThoseWithoutItems(List<Long> numbers, Throwable why) {
        fail(
                numbers.stream()
                        .filter(number -> open.containsKey(number) && open.get(number).expected == 1)
                        .toList(),
                why);
    }

    /** They were not used. */
    void forget(List<Long> numbers) {
        open.keySet().removeAll(numbers);
    }

    /** Ends the streams of an actor that is gone. */
    void failAllOf(RemoteActor actor, Throwable why) {
        failAll(stream -> stream.from == actor, why);
    }

    void failAll(Throwable why) {
        failAll(stream -> true, why);
    }

    private void failAll(Predicate<Stream> some, Throwable why) {
        List<Stream> ended = open.values().stream().filter(some).toList();
        open.values().removeAll(ended);
        ended.forEach(stream -> fail(stream, why));
    }

    private static void fail(@Nullable Stream stream, Throwable why) {
        if (stream != null) {
            stream.callback.fail(why);
        }
    }
}
