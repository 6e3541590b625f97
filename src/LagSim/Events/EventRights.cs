using System;
using LagSim.Scenes;

namespace LagSim.Events;

/// <summary>
/// Which peer may do what, if the scene or a spawn limits it. A host uses it to validate events. A world by itself knows only the rights to
/// spawned bodies: what a peer does to one that it may not touch has no effect there.
/// </summary>
public static class EventRights
{
    /// <summary>
    /// Whether the peer that did this may do it: spawn at all, or touch that body.
    /// </summary>
    /// <param name="external">What it did.</param>
    /// <param name="scene">The scene, which says who may touch its bodies.</param>
    /// <param name="ofSpawned">Who may touch that body if it is a spawned one: what its spawn said, by default everyone.</param>
    public static bool Has(in ExternalEvent external, Scene scene, PeerSet ofSpawned = default)
    {
        if (scene is null)
        {
            throw new ArgumentNullException(nameof(scene));
        }

        return external.Kind == EventKind.Spawn ? scene.Spawners.Contains(external.Peer)
            : TryFind(external.Body, scene, out SceneBody body) ? body.Players.Contains(external.Peer) : MayTouch(external, ofSpawned);
    }

    /// <summary>
    /// Whether a peer may do that to a spawned body, which belongs to some. The host may remove any: it clears up after who has left. Rules may
    /// do anything.
    /// </summary>
    internal static bool MayTouch(in ExternalEvent external, PeerSet players) =>
        players.Contains(external.Peer) || (external.Peer == 0 && external.Kind == EventKind.Remove) || external.Peer == SceneRules.Peer;

    /// <summary>Throws if the peer that did this may not do it.</summary>
    /// <param name="external">What it did.</param>
    /// <param name="scene">The scene, which says who may touch its bodies.</param>
    /// <param name="ofSpawned">Who may touch that body if it is a spawned one.</param>
    /// <exception cref="SceneException">The message names the peer, its action, and the peers that may do it.</exception>
    public static void Throw(in ExternalEvent external, Scene scene, PeerSet ofSpawned = default)
    {
        if (Has(external, scene, ofSpawned))
        {
            return;
        }

        throw new SceneException(external.Kind != EventKind.Spawn && !TryFind(external.Body, scene, out _)
            ? $"Peer {external.Peer} may not touch the spawned body {external.Body}; those who may: {ofSpawned}."
            : TryFind(external.Body, scene, out SceneBody body) && external.Kind != EventKind.Spawn
            ? $"Peer {external.Peer} may not touch body '{body.Name}'; those who may: {body.Players}."
            : $"Peer {external.Peer} may not spawn bodies in scene '{scene.Name}'; those who may: {scene.Spawners}.");
    }

    private static bool TryFind(BodyId id, Scene scene, out SceneBody body)
    {
        bool isOfScene = id.Peer == 0 && id.Sequence == 0 && id.Index < scene.BodyArray.Length;
        body = isOfScene ? scene.BodyArray[id.Index] : default;
        return isOfScene;
    }
}
