package io.troupe.actor.internal;

import io.troupe.actor.Request;
import io.troupe.actor.internal.loop.PlainText;
import io.troupe.actor.internal.loop.QueueEntry;
import io.troupe.actor.internal.loop.TurnOwner;
import java.util.Arrays;
import java.util.stream.Collectors;
import org.jspecify.annotations.Nullable;

/**
 * A one-way message. For generated code: each {@code void} method of an actor type has a subclass whose fields are the
 * arguments.
 */
public abstract class Message extends QueueEntry {
    private final Recipient receiver;

    protected Message(Recipient receiver) {
        this.receiver = receiver;
    }

    /** Calls the method. */
    protected abstract void invoke(Object implementation) throws Throwable;

    /** The type's and the method's name, and parameter types: {@code Greeter.greet(String)}. */
    protected abstract String method();

    /** The arguments, for log and error messages. */
    protected abstract Object[] arguments();

    public final Recipient receiver() {
        return receiver;
    }

    /** Repeated in each generated class, to keep its call site of {@code invoke} monomorphic. */
    @Override
    protected @Nullable QueueEntry serve() throws Throwable {
        Object target = target();
        if (target != null) {
            invoke(target);
        }
        return null;
    }

    /** Like {@link #serve}, for a target that has already been looked up. */
    public final void serveWith(Object target) throws Throwable {
        invoke(target);
    }

    /** The target to invoke, or null if the message was already handled or rejected. */
    protected final @Nullable Object target() {
        return receiver.target(this);
    }

    @Override
    protected final void threw(Throwable thrown) {
        receiver.failed(this, thrown);
    }

    @Override
    protected final boolean isMessage() {
        return true;
    }

    @Override
    protected final TurnOwner turnOwner() {
        return receiver().life();
    }

    /** The arguments of a call, or none if the entry is no call. */
    public static @Nullable Object[] argumentsOf(QueueEntry call) {
        // no switch: linking it could fail in a caller with little stack left
        if (call instanceof Message message) {
            return message.arguments();
        }
        return call instanceof Request<?> request ? request.arguments() : new Object[0];
    }

    /** The name of the method of a call, without its type; empty if the entry is no call. */
    public static String methodOf(QueueEntry call) {
        String name = call instanceof Message message
                ? nameOf(message.method())
                : call instanceof Request<?> request ? nameOf(request.method()) : "";
        return name.substring(name.lastIndexOf('.') + 1);
    }

    /** The name and parameter types of the method of a call, without its type; empty if the entry is no call. */
    public static String signatureOf(QueueEntry call) {
        String method = call instanceof Message message
                ? message.method()
                : call instanceof Request<?> request ? request.method() : "";
        return method.substring(method.indexOf('.') + 1);
    }

    private static String nameOf(String method) {
        return method.substring(0, method.indexOf('('));
    }

    /** The method, without the values of the arguments: these may be secret, and their texts are the user's code. */
    @Override
    public final String toString() {
        return method();
    }

    /** The method and parameter types of a call; the text of anything else. */
    public static String methodOrWords(Object what) {
        return what instanceof Request<?> request ? request.method() : what.toString();
    }

    /** The values of the arguments, abbreviated: only for those who have asked for them. */
    public static String argumentsInWords(QueueEntry call) {
        return Arrays.stream(argumentsOf(call)).map(PlainText::of).collect(Collectors.joining(", "));
    }
}
