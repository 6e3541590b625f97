using System;
using LagSim.Events;

namespace LagSim.Timelines;

/// <summary>Numbered events in canonical order: trees in which one is found, added or removed in a time of log n, in whatever order they come.</summary>
/// <remarks>
/// <para>Balanced by levels: Andersson 1993, "Balanced search trees made simple" (LNCS 709, 60-71). Unlike a tree that is balanced by chance, no order
/// of arrival makes it deep, so a player cannot make it slow.</para>
/// <para>Several trees share the numbers, and each is known by its root. Allocates only when there are more events than ever before. Not
/// thread-safe.</para>
/// </remarks>
internal class EventOrder
{
    internal const int None = -1;

    private Node[] nodes = Array.Empty<Node>();

    /// <summary>The key of an event that is in a tree.</summary>
    internal ref readonly EventKey Key(int number) => ref nodes[number].Key;

    /// <summary>Adds an event to a tree that has none of that key.</summary>
    internal void Add(ref int root, int added, in EventKey key)
    {
        if (added >= nodes.Length)
        {
            Array.Resize(ref nodes, Math.Max(added + 1, nodes.Length * 2));
        }

        nodes[added] = new Node { Key = key, Left = None, Right = None, Level = 1 };
        root = Insert(root, added);
    }

    /// <summary>Removes an event from the tree that it is in.</summary>
    internal void Remove(ref int root, int removed) => root = Delete(root, removed);

    /// <summary>The last event of a tree that is keyed before <paramref name="key"/>, or <see cref="None"/>.</summary>
    internal int LastBefore(int root, in EventKey key)
    {
        int found = None;
        for (int at = root; at != None;)
        {
            bool isBefore = EventKey.Compare(nodes[at].Key, key) < 0;
            found = isBefore ? at : found;
            at = isBefore ? nodes[at].Right : nodes[at].Left;
        }

        return found;
    }

    /// <summary>The first event of a tree that is keyed after <paramref name="key"/>, or <see cref="None"/>.</summary>
    internal int FirstAfter(int root, in EventKey key)
    {
        int found = None;
        for (int at = root; at != None;)
        {
            bool isAfter = EventKey.Compare(nodes[at].Key, key) > 0;
            found = isAfter ? at : found;
            at = isAfter ? nodes[at].Left : nodes[at].Right;
        }

        return found;
    }

    /// <summary>How many events a search of a tree looks at, at most. For whoever measures: it looks at all of them.</summary>
    internal int DepthOf(int root) => root == None ? 0 : 1 + Math.Max(DepthOf(nodes[root].Left), DepthOf(nodes[root].Right));

    private int Insert(int tree, int added)
    {
        if (tree == None)
        {
            return added;
        }

        if (EventKey.Compare(nodes[added].Key, nodes[tree].Key) < 0)
        {
            nodes[tree].Left = Insert(nodes[tree].Left, added);
        }
        else
        {
            nodes[tree].Right = Insert(nodes[tree].Right, added);
        }

        return Split(Skew(tree));
    }

    private int Delete(int tree, int removed)
    {
        if (tree != removed)
        {
            if (EventKey.Compare(nodes[removed].Key, nodes[tree].Key) < 0)
            {
                nodes[tree].Left = Delete(nodes[tree].Left, removed);
            }
            else
            {
                nodes[tree].Right = Delete(nodes[tree].Right, removed);
            }
        }
        else if (nodes[tree].Left == None)
        {
            return nodes[tree].Right; // of the lowest level, so it has no other
        }
        else
        {
            int next = nodes[tree].Right;
            while (nodes[next].Left != None)
            {
                next = nodes[next].Left;
            }

            int right = Delete(nodes[tree].Right, next);
            nodes[next].Left = nodes[tree].Left;
            nodes[next].Right = right;
            nodes[next].Level = nodes[tree].Level;
            tree = next;
        }

        return Lower(tree);
    }

    /// <summary>Restores the levels of a tree that has lost an event below.</summary>
    private int Lower(int tree)
    {
        int level = Math.Min(LevelOf(nodes[tree].Left), LevelOf(nodes[tree].Right)) + 1;
        if (level >= nodes[tree].Level)
        {
            return tree;
        }

        nodes[tree].Level = level;
        if (LevelOf(nodes[tree].Right) > level)
        {
            nodes[nodes[tree].Right].Level = level;
        }

        tree = Skew(tree);
        int right = nodes[tree].Right;
        if (right != None)
        {
            right = Skew(right);
            nodes[tree].Right = right;
            if (nodes[right].Right != None)
            {
                nodes[right].Right = Skew(nodes[right].Right);
            }
        }

        tree = Split(tree);
        if (nodes[tree].Right != None)
        {
            nodes[tree].Right = Split(nodes[tree].Right);
        }

        return tree;
    }

    private int LevelOf(int tree) => tree == None ? 0 : nodes[tree].Level;

    /// <summary>None on the left is of its own level: turned to the right.</summary>
    private int Skew(int tree)
    {
        int left = nodes[tree].Left;
        if (LevelOf(left) != nodes[tree].Level)
        {
            return tree;
        }

        nodes[tree].Left = nodes[left].Right;
        nodes[left].Right = tree;
        return left;
    }

    /// <summary>Of three of one level in a row the middle one rises.</summary>
    private protected virtual int Split(int tree)
    {
        int right = nodes[tree].Right;
        if (right == None || LevelOf(nodes[right].Right) != nodes[tree].Level)
        {
            return tree;
        }

        nodes[tree].Right = nodes[right].Left;
        nodes[right].Left = tree;
        nodes[right].Level++;
        return right;
    }

    private struct Node
    {
        internal EventKey Key;
        internal int Left;
        internal int Right;
        internal int Level;
    }
}
