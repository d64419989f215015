package io.troupe.actor.internal.loop;

import java.lang.invoke.MethodHandles;
import java.lang.invoke.VarHandle;
import java.util.Objects;
import org.jspecify.annotations.Nullable;

/** The field written by the consumer. */
abstract class QueueHead extends CacheLinePadding {
    QueueEntry head = new Stub();

    private static final class Stub extends QueueEntry {}
}

/** Padding between the consumer's field and the producers' field. */
@SuppressWarnings("unused")
abstract class QueueHeadPadding extends QueueHead {
    private byte q000, q001, q002, q003, q004, q005, q006, q007, q008, q009, q010, q011, q012, q013, q014, q015;
    private byte q016, q017, q018, q019, q020, q021, q022, q023, q024, q025, q026, q027, q028, q029, q030, q031;
    private byte q032, q033, q034, q035, q036, q037, q038, q039, q040, q041, q042, q043, q044, q045, q046, q047;
    private byte q048, q049, q050, q051, q052, q053, q054, q055, q056, q057, q058, q059, q060, q061, q062, q063;
    private byte q064, q065, q066, q067, q068, q069, q070, q071, q072, q073, q074, q075, q076, q077, q078, q079;
    private byte q080, q081, q082, q083, q084, q085, q086, q087, q088, q089, q090, q091, q092, q093, q094, q095;
    private byte q096, q097, q098, q099, q100, q101, q102, q103, q104, q105, q106, q107, q108, q109, q110, q111;
    private byte q112, q113, q114, q115, q116, q117, q118, q119, q120, q121, q122, q123, q124, q125, q126, q127;
}

/** The field written by producers. */
abstract class QueueTail extends QueueHeadPadding {
    volatile QueueEntry tail = head;
}

/**
 * An unbounded queue of entries, from many threads to one.
 *
 * <p><b>Role.</b> A space's inbox. Internal to this library.
 *
 * <p><b>Threads.</b> {@link #offer} from any thread; {@link #poll}, {@link #isEmpty} and the batch methods from one
 * thread at a time. What a thread did before {@code offer} is visible to the thread that takes the node.
 *
 * <p><b>Order.</b> First in, first out per offering thread; between threads, the order of their atomic exchanges.
 *
 * <p><b>Cost.</b> One atomic exchange per offer, no allocation.
 */
@SuppressWarnings("unused")
public final class EntryQueue extends QueueTail {
    /*
     * A linked queue whose links are the entries themselves. The entry returned last stays in the queue as its stub,
     * and must not be linked into anything else meanwhile. Its own link is cleared when the next entry is taken, so
     * that a retained entry retains no other.
     */
    private static final VarHandle TAIL;
    private static final VarHandle NEXT;

    private final QueueEntry idleStub = head; // the first stub: never offered, and used only while it is the head

    private byte r000, r001, r002, r003, r004, r005, r006, r007, r008, r009, r010, r011, r012, r013, r014, r015;
    private byte r016, r017, r018, r019, r020, r021, r022, r023, r024, r025, r026, r027, r028, r029, r030, r031;
    private byte r032, r033, r034, r035, r036, r037, r038, r039, r040, r041, r042, r043, r044, r045, r046, r047;
    private byte r048, r049, r050, r051, r052, r053, r054, r055, r056, r057, r058, r059, r060, r061, r062, r063;
    private byte r064, r065, r066, r067, r068, r069, r070, r071, r072, r073, r074, r075, r076, r077, r078, r079;
    private byte r080, r081, r082, r083, r084, r085, r086, r087, r088, r089, r090, r091, r092, r093, r094, r095;
    private byte r096, r097, r098, r099, r100, r101, r102, r103, r104, r105, r106, r107, r108, r109, r110, r111;
    private byte r112, r113, r114, r115, r116, r117, r118, r119, r120, r121, r122, r123, r124, r125, r126, r127;

    static {
        try {
            var lookup = MethodHandles.lookup();
            TAIL = lookup.findVarHandle(QueueTail.class, "tail", QueueEntry.class);
            NEXT = lookup.findVarHandle(QueueEntry.class, "next", QueueEntry.class);
        } catch (ReflectiveOperationException e) {
            throw new ExceptionInInitializerError(e);
        }
    }

    /**
     * Appends an entry that is in no queue. The atomic exchange is ordered before the caller's next read. If this
     * throws (a stack overflow), the entry was not appended.
     */
    public void offer(QueueEntry node) {
        node.next = null;
        VarHandle.releaseFence(); // publishes the entry's fields before the link below
        var before = (QueueEntry) TAIL.getAndSet(this, node);
        before.next = node; // no call here: a stack overflow between the exchange and this store would lose the link
    }

    /**
     * Takes the oldest entry. Returns null if there is none, or if its offer has not yet completed; {@link #isEmpty}
     * distinguishes the two cases.
     */
    public @Nullable QueueEntry poll() {
        if (!isReadyAfter(head)) {
            return null;
        }
        QueueEntry first = takeAfter(head);
        head = first;
        return first;
    }

    /** True if every entry that was offered has been taken. */
    public boolean isEmpty() {
        return head == tail;
    }

    /** The entry that was offered last, or null if the queue is empty. */
    public @Nullable QueueEntry newest() {
        QueueEntry last = tail;
        return last == head ? null : last;
    }

    /**
     * True if {@link #poll} would return an entry; unlike {@link #isEmpty} it does not read the producers' cache line.
     */
    public boolean isReady() {
        return NEXT.getAcquire(head) != null;
    }

    /** The number of queued entries, without those offered during the call. Takes time proportional to the number. */
    public int size() {
        int size = 0;
        QueueEntry last = tail;
        for (QueueEntry node = head; node != null && node != last; node = (QueueEntry) NEXT.getAcquire(node)) {
            size++;
        }
        return size;
    }

    /**
     * The number of nodes ahead of this one, or -1 if it is not among the first {@code limit}. Takes time proportional
     * to the limit.
     */
    public int indexOf(QueueEntry wanted, int limit) {
        var node = (QueueEntry) NEXT.getAcquire(head);
        for (int index = 0; node != null && index < limit; index++) {
            if (node.carries(wanted)) {
                return index;
            }
            node = (QueueEntry) NEXT.getAcquire(node);
        }
        return -1;
    }

    /** True if more than {@code limit} nodes are queued. Takes time proportional to the limit. */
    public boolean isLongerThan(int limit) {
        int size = 0;
        for (var node = (QueueEntry) NEXT.getAcquire(head); node != null; node = (QueueEntry) NEXT.getAcquire(node)) {
            if (++size > limit) {
                return true;
            }
        }
        return false;
    }

    /**
     * Begins a batch and returns the entry taken last. A batch is a sequence of {@link #takeAfter} calls, each with the
     * entry that the call before returned, and one {@link #endBatch} with the last of them. It saves one store per
     * entry.
     */
    public QueueEntry beginBatch() {
        return head;
    }

    /** True if there is an entry behind the one taken last. */
    public boolean isReadyAfter(QueueEntry last) {
        return NEXT.getAcquire(last) != null;
    }

    /** Takes the entry behind the one taken last; requires {@link #isReadyAfter}. */
    public QueueEntry takeAfter(QueueEntry last) {
        QueueEntry first = Objects.requireNonNull(last.next);
        last.next = null;
        return first;
    }

    public void endBatch(QueueEntry last) {
        if (head != last) {
            head = last;
        }
    }

    /** Releases the entry that was taken last, if the queue is empty; called when the consumer is idle. */
    public void forgetLast() {
        QueueEntry last = head;
        if (last != idleStub && last == tail && TAIL.compareAndSet(this, last, idleStub)) {
            head = idleStub; // its link is null: the entry behind it was taken
        }
    }
}
