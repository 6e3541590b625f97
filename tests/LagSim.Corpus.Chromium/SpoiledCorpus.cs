using System;
using System.IO;
using System.Linq;
using LagSim.Net.Recordings;
using LagSim.Net.Sessions;

namespace LagSim.Corpus.Chromium;

/// <summary>A copy of the corpus in which one recording lacks its last event: who finds the same hashes for it has not replayed it.</summary>
internal sealed class SpoiledCorpus : IDisposable
{
    /// <summary>The recording that is changed.</summary>
    internal const string Name = "pair";

    internal SpoiledCorpus(string corpus)
    {
        Folder = Directory.CreateTempSubdirectory("lagsim-corpus-").FullName;
        foreach (string file in Directory.EnumerateFiles(corpus))
        {
            File.Copy(file, Path.Combine(Folder, Path.GetFileName(file)));
        }

        string path = Path.Combine(Folder, Name + RecordingFormat.Extension);
        Recording was = Recording.Read(path, [new DragAndSpring(), new Eddy()]);
        using RecordingWriter writer = RecordingWriter.Create(path, was.Header!.Peer, was.Scene!, was.Header.Start);
        foreach (LogEntry entry in was.Entries.SkipLast(1))
        {
            writer.WriteEntry(entry.Index, entry.Verdict, entry.Event);
        }

        foreach (CommittedState state in was.Committed)
        {
            writer.WriteCommitted(state.Time, state.StateHash, state.EventHash);
        }

        writer.WriteEnd("Spoiled.");
    }

    /// <summary>Where it is.</summary>
    internal string Folder { get; }

    public void Dispose() => Directory.Delete(Folder, recursive: true);
}
