package io.troupe.actor.kotlin.ports.troupe

import io.troupe.actor.ActorSpace
import io.troupe.actor.Callback
import io.troupe.actor.kotlin.callbacks
import io.troupe.actor.kotlin.ports.ChatRoom
import io.troupe.actor.kotlin.spawn
import kotlinx.coroutines.flow.Flow

interface Room {
    fun enter(name: String, inbox: Callback<String>)

    suspend fun say(name: String, line: String): Int
}

class RoomActor : Room {
    private val members = mutableMapOf<String, Callback<String>>()

    override fun enter(name: String, inbox: Callback<String>) {
        members[name] = inbox
    }

    override suspend fun say(name: String, line: String): Int {
        members.values.removeIf { it.isCancelled }
        val others = members - name
        others.values.forEach { it.next("$name: $line") }
        return others.size
    }
}

fun chatRoom(space: ActorSpace): ChatRoom {
    val room = space.spawn<Room> { RoomActor() }
    return object : ChatRoom {
        override fun join(name: String): Flow<String> = callbacks { room.enter(name, it) }

        override suspend fun say(name: String, line: String) = room.say(name, line)
    }
}
