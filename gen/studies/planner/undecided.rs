//! Why the unit leaves pairs of a scene open.

use super::Contact;
use efsat_geometry::scene::{Meeting, Scene};
use efsat_unit::golden::{Golden, Reason};
use efsat_unit::host::{ReadyMeeting, ReadyScene, ScenePose};
use efsat_unit::pair::Verdict;
use efsat_unit::params::Params;

/// A scene and a unit that is asked for reasons.
pub struct Undecided<'a> {
    stage: ReadyScene<'a>,
    golden: Golden,
}

impl<'a> Undecided<'a> {
    /// Asks the unit of some parameters.
    pub fn new(scene: &'a Scene, params: &Params) -> Self {
        Self { stage: ReadyScene::new(scene, params), golden: Golden::new(params) }
    }

    /// Why each of some contacts of a frame is undecided; none of those that are decided.
    pub fn reasons(&self, frame: usize, contacts: &[Contact]) -> Vec<Option<Reason>> {
        let meetings = self.stage.near.meetings(frame);
        let meeting =
            |contact: &Contact| meetings.iter().find(|meeting| (meeting.a, meeting.b) == contact.place.objects);
        let of_objects = contacts.chunk_by(|p, q| p.place.objects == q.place.objects);
        of_objects.flat_map(|contacts| self.of_meeting(meeting(&contacts[0]), contacts)).collect()
    }

    fn of_meeting(&self, meeting: Option<&Meeting>, contacts: &[Contact]) -> Vec<Option<Reason>> {
        let Some(meeting) = meeting.filter(|_| contacts.iter().any(is_open)) else {
            return vec![None; contacts.len()];
        };
        let posed = self.stage.posed(meeting);
        let host = posed.host();
        contacts.iter().map(|contact| reason(&self.golden, &posed, &host, contact)).collect()
    }
}

fn is_open(contact: &Contact) -> bool {
    contact.verdict == Some(Verdict::PossiblyIncorrect)
}

/// Why a contact of a meeting is undecided; none of one that is decided.
pub(super) fn reason(
    golden: &Golden,
    posed: &ReadyMeeting<'_>,
    host: &ScenePose<'_>,
    contact: &Contact,
) -> Option<Reason> {
    let [a, b] = posed.faces(contact.place.pair);
    is_open(contact).then(|| host.pair(a, b).reason(golden, &host.pose)).flatten()
}
