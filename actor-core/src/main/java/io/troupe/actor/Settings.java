package io.troupe.actor;

import java.lang.invoke.VarHandle;
import java.util.function.Consumer;

/**
 * The form of all settings: an immutable object with a method {@code with..} for each setting, which returns a copy.
 *
 * {@snippet :
 * ActorSettings settings = ActorSettings.named("counter").withMailbox(1_000, Overflow.REJECT);
 * ActorSettings unlimited = settings.withoutMailboxLimit();
 * }
 *
 * <p><b>No limit.</b> A setting that can be without a limit has a method {@code without..}, and reads as null then.
 *
 * <p><b>Errors.</b> A value that makes no sense is rejected with an {@link IllegalArgumentException} by the method that
 * sets it.
 *
 * @param <S> the class of the settings
 */
public abstract class Settings<S extends Settings<S>> implements Cloneable {
    protected Settings() {}

    /** Returns a checked copy with a change. Subclasses write to their fields only in such a change. */
    protected final S with(Consumer<S> change) {
        S copy = copy();
        change.accept(copy);
        copy.check();
        VarHandle.releaseFence(); // as after the last write of a final field: other threads see the copy as it is now
        return copy;
    }

    @SuppressWarnings("unchecked") // S is the class of this object
    private S copy() {
        try {
            return (S) clone();
        } catch (CloneNotSupportedException impossible) {
            throw new AssertionError(impossible);
        }
    }

    /** Throws an {@link IllegalArgumentException} if a value makes no sense. */
    protected abstract void check();
}
