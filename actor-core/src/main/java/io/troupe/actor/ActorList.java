package io.troupe.actor;

import java.util.ArrayList;
import java.util.List;
import org.jspecify.annotations.Nullable;

/**
 * The actors of a space that have started and not stopped, in the order of their start. The list is linked through the
 * cells, so that an actor needs no list node.
 */
final class ActorList {
    private @Nullable ActorCell first;
    private @Nullable ActorCell last;
    private int size;

    int size() {
        return size;
    }

    /** Appends a cell. No effect if it is already in the list: a restarted actor keeps its position. */
    void add(ActorCell cell) {
        if (contains(cell)) {
            return;
        }
        cell.before = last;
        if (last == null) {
            first = cell;
        } else {
            last.after = cell;
        }
        last = cell;
        size++;
    }

    void remove(ActorCell cell) {
        if (!contains(cell)) {
            return;
        }
        if (cell.before == null) {
            first = cell.after;
        } else {
            cell.before.after = cell.after;
        }
        if (cell.after == null) {
            last = cell.before;
        } else {
            cell.after.before = cell.before;
        }
        cell.before = null;
        cell.after = null;
        size--;
    }

    private boolean contains(ActorCell cell) {
        return cell.before != null || first == cell;
    }

    List<ActorCell> all() {
        var cells = new ArrayList<ActorCell>(size);
        for (ActorCell cell = first; cell != null; cell = cell.after) {
            cells.add(cell);
        }
        return cells;
    }
}
